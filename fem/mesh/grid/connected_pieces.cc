#include "fem/mesh/grid/connected_pieces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

#include "fem/base/values/errors.h"
#include "fem/mesh/grid/cell_geometry.h"

namespace fem {

namespace {

struct Face {
  std::array<std::int32_t, 4> corners{};  // ascending; of a triangle the first is -1
  std::int32_t cell = 0;
  int number = 0;  // in the cell
};

std::vector<Face> all_faces(const Grid& grid) {
  const auto places = face_corners(grid.shape());
  const int n_faces = grid.shape().n_faces();
  std::vector<Face> faces;
  faces.reserve(grid.n_cells() * std::size_t(n_faces));
  for (int f = 0; f < n_faces; ++f) {
    const auto nodes = face_nodes(grid.shape(), f);
    for (std::size_t c = 0; c < grid.n_cells(); ++c) {
      Face face{{-1, -1, -1, -1}, static_cast<std::int32_t>(c), f};
      for (std::size_t k = 0; k < places.size(); ++k) face.corners[k] = grid.nodes_of(c)[nodes[places[k]]];
      std::sort(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  }
  return faces;
}

/// For each cell one cell of its piece, the same for all of the piece.
std::vector<std::int32_t> pieces_of_cells(const Grid& grid) {
  std::vector<std::int32_t> parent(grid.n_cells());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto beyond = cells_beyond_faces(grid);
  const auto n_faces = beyond.size() / grid.n_cells();
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (beyond[k] >= 0) {
      const auto a = root(static_cast<std::int32_t>(k / n_faces)), b = root(beyond[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t c = 0; c < parent.size(); ++c) parent[c] = root(static_cast<std::int32_t>(c));
  return parent;
}

/// Mean of the cell's nodes.
std::array<double, 3> centre(const Grid& grid, std::size_t cell) {
  std::array<double, 3> x{};
  for (int i = 0; i < grid.nodes_per_cell(); ++i)
    for (int d = 0; d < 3; ++d) x[d] += grid.position(grid.nodes_of(cell)[i])[d] / grid.nodes_per_cell();
  return x;
}

}  // namespace

std::vector<std::int32_t> cells_beyond_faces(const Grid& grid) {
  const auto n_faces = std::size_t(grid.shape().n_faces());
  std::vector<std::int32_t> beyond(grid.n_cells() * n_faces, -1);
  auto faces = all_faces(grid);
  std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.corners < b.corners; });
  for (std::size_t k = 1; k < faces.size(); ++k)
    if (faces[k].corners == faces[k - 1].corners)
      for (const auto& [own, other] : {std::pair(faces[k], faces[k - 1]), std::pair(faces[k - 1], faces[k])})
        beyond[std::size_t(own.cell) * n_faces + std::size_t(own.number)] = other.cell;
  return beyond;
}

void refuse_several_pieces(const Grid& grid) {
  std::map<std::int32_t, std::size_t> n_cells;  // by the first cell of a piece
  for (const auto piece : pieces_of_cells(grid)) ++n_cells[piece];
  if (n_cells.size() <= 1) return;
  std::vector<std::pair<std::int32_t, std::size_t>> pieces(n_cells.begin(), n_cells.end());
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t shown = 5;
  std::ostringstream message;
  message << "the mesh is in " << pieces.size() << " pieces that share no face:";
  for (std::size_t k = 0; k < std::min(shown, pieces.size()); ++k) {
    const auto x = centre(grid, std::size_t(pieces[k].first));
    message << (k > 0 ? "," : "") << " " << pieces[k].second << " cells near (" << x[0] << ", " << x[1]
            << ", " << x[2] << ") m in volume " << grid.volume_id[pieces[k].first];
  }
  if (pieces.size() > shown) message << " and others";
  message << "; join them (one solid, or volumes that share their surfaces), or make a body of each";
  throw MeshUnusable(message.str());
}

}  // namespace fem
