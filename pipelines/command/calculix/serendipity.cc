#include "pipelines/command/calculix/serendipity.h"

#include <algorithm>
#include <stdexcept>

namespace pipelines {
namespace {

constexpr double corner_weight =
    -0.25;  // (1/8) (1 + 1 - 2) on a face with both signs, (1/8) (-2) in the cell

/// Corners and edges of the face whose middle is node 20 + f of VTK_TRIQUADRATIC_HEXAHEDRON:
/// x = 0, x = 1, y = 0, y = 1, z = 0, z = 1.
constexpr std::array<std::array<std::size_t, 8>, 6> face_parents = {{{0, 3, 7, 4, 11, 19, 15, 16},
                                                                     {1, 2, 6, 5, 9, 18, 13, 17},
                                                                     {0, 1, 5, 4, 8, 17, 12, 16},
                                                                     {3, 2, 6, 7, 10, 18, 14, 19},
                                                                     {0, 1, 2, 3, 8, 9, 10, 11},
                                                                     {4, 5, 6, 7, 12, 13, 14, 15}}};

}  // namespace

Serendipity::Serendipity(const fem::Nodes& nodes) : kept_(nodes.n, 1) {
  if (nodes.cells.empty() || nodes.degree != 2)
    throw std::invalid_argument("only cells of degree 2 have an equal of 20 nodes");
  if (nodes.kind == fem::CellKind::tetrahedra) return;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    for (std::size_t f = 0; f < face_parents.size(); ++f) {
      if (!kept_[std::size_t(cell[20 + f])]) continue;  // the neighbour's too
      Dropped face{cell[20 + f], 8, 4, {}, 0.5};
      for (std::size_t i = 0; i < 8; ++i) face.parents[i] = cell[face_parents[f][i]];
      kept_[std::size_t(face.node)] = 0;
      dropped_.push_back(face);
    }
    Dropped centre{cell[26], n_serendipity_nodes, 8, {}, 0.25};
    std::copy_n(cell.begin(), n_serendipity_nodes, centre.parents.begin());
    kept_[std::size_t(centre.node)] = 0;
    dropped_.push_back(centre);
  }
}

void Serendipity::condense(double* values, std::size_t width) const {
  for (const auto& from : dropped_)
    for (std::size_t d = 0; d < width; ++d) {
      double& value = values[std::size_t(from.node) * width + d];
      for (std::size_t i = 0; i < from.n_parents; ++i)
        values[std::size_t(from.parents[i]) * width + d] +=
            (i < from.n_corners ? corner_weight : from.edge_weight) * value;
      value = 0;
    }
}

void Serendipity::extend(double* values, std::size_t width) const {
  for (const auto& to : dropped_)
    for (std::size_t d = 0; d < width; ++d) {
      double value = 0;
      for (std::size_t i = 0; i < to.n_parents; ++i)
        value += (i < to.n_corners ? corner_weight : to.edge_weight) *
                 values[std::size_t(to.parents[i]) * width + d];
      values[std::size_t(to.node) * width + d] = value;
    }
}

}  // namespace pipelines
