#include <algorithm>
#include <array>
#include <map>

#include "fem/common/lagrange.h"
#include "fem/submodel/cut_cells.h"

namespace fem {
namespace {

/// A point of the 5 x 5 x 5 lattice in a cell: the old nodes are those whose coordinates are all even.
using LatticePoint = std::array<int, 3>;

int old_node(const LatticePoint& at) {
  return at[0] / 2 + 3 * (at[1] / 2) + 9 * (at[2] / 2);
}

/// The old nodes beside a lattice point along its odd coordinates: two on an edge, four on a face, eight
/// inside. They name it, whichever cell it is seen from; unused places are -1.
using Name = std::array<std::int32_t, 8>;

Name name_of(const LatticePoint& at, const std::int32_t* nodes) {
  Name name;
  name.fill(-1);
  std::size_t n = 0;
  for (int corner = 0; corner < 8; ++corner) {
    LatticePoint beside = at;
    bool is_new = true;
    for (std::size_t d = 0; d < 3; ++d) {
      const int side = corner >> d & 1;
      if (at[d] % 2 == 1)
        beside[d] += 2 * side - 1;
      else
        is_new = is_new && side == 0;
    }
    if (is_new) name[n++] = nodes[old_node(beside)];
  }
  std::sort(name.begin(), name.end());
  return name;
}

/// The 27 shape functions of a quadratic hexahedron at the lattice points.
std::array<double, 27> shapes_at(const LatticePoint& at) {
  const auto ends = nodes_on_edge(2);
  std::array<std::vector<double>, 3> along;
  for (std::size_t d = 0; d < 3; ++d)
    for (const auto& function : lagrange(ends, at[d] / 4.0)) along[d].push_back(function.value);
  std::array<double, 27> values{};
  for (std::size_t i = 0; i < 27; ++i) values[i] = along[0][i % 3] * along[1][i / 3 % 3] * along[2][i / 9];
  return values;
}

class HexahedraCutter {
public:
  explicit HexahedraCutter(const GridField& coarse) : coarse_(coarse) {
    fine_.grid.n_nodes = coarse.grid.n_nodes;
    fine_.grid.xyz_m = coarse.grid.xyz_m;
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i) shapes_.push_back(shapes_at({i, j, k}));
  }

  GridField cut() {
    for (std::size_t c = 0; c < coarse_.grid.n_cells(); ++c) cut(c);
    // Faces keep their number: part p of a cell is at the low or the high end of each axis as its bits say.
    for (const auto& face : coarse_.grid.boundary)
      for (int part = 0; part < 8; ++part)
        if ((part >> (face.face / 2) & 1) == face.face % 2)
          fine_.grid.boundary.push_back({8 * face.cell + part, face.face, face.boundary_id});
    fine_.field = with_rows_below(coarse_.field, values_);
    return std::move(fine_);
  }

private:
  void cut(std::size_t c) {
    std::array<std::int32_t, 125> lattice{};
    for (int place = 0; place < 125; ++place)
      lattice[std::size_t(place)] =
          node_at({place % 5, place / 5 % 5, place / 25}, coarse_.grid.nodes_of(c), std::size_t(place));
    for (int part = 0; part < 8; ++part) {
      for (int place = 0; place < 27; ++place) {
        const int x = place % 3 + 2 * (part & 1), y = place / 3 % 3 + 2 * (part >> 1 & 1),
                  z = place / 9 + 2 * (part >> 2);
        const int at = x + 5 * y + 25 * z;
        fine_.grid.cell_nodes.push_back(lattice[std::size_t(at)]);
      }
      fine_.grid.volume_id.push_back(coarse_.grid.volume_id[c]);
    }
  }

  std::int32_t node_at(const LatticePoint& at, const std::int32_t* nodes, std::size_t place) {
    if (at[0] % 2 == 0 && at[1] % 2 == 0 && at[2] % 2 == 0) return nodes[old_node(at)];
    const auto [known, is_new] = names_.try_emplace(name_of(at, nodes), std::int32_t(fine_.grid.n_nodes));
    if (!is_new) return known->second;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    Eigen::RowVectorXd value = Eigen::RowVectorXd::Zero(coarse_.field.cols());
    for (std::size_t i = 0; i < 27; ++i) {
      x += shapes_[place][i] * Eigen::Map<const Eigen::Vector3d>(coarse_.grid.position(nodes[i]));
      value += shapes_[place][i] * coarse_.field.row(nodes[i]);
    }
    fine_.grid.xyz_m.insert(fine_.grid.xyz_m.end(), x.data(), x.data() + 3);
    values_.push_back(value);
    ++fine_.grid.n_nodes;
    return known->second;
  }

  const GridField& coarse_;
  std::vector<std::array<double, 27>> shapes_;  // at each lattice point
  std::map<Name, std::int32_t> names_;
  std::vector<Eigen::RowVectorXd> values_;  // at the new nodes
  GridField fine_;
};

}  // namespace

GridField cut_hexahedra(const GridField& coarse) {
  return HexahedraCutter(coarse).cut();
}

}  // namespace fem
