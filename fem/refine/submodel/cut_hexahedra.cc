#include <algorithm>
#include <array>
#include <map>

#include "fem/mesh/grid/reference_cell.h"
#include "fem/refine/submodel/cut_cells.h"

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

/// The 125 lattice points in the reference cell.
ReferencePoints lattice_points() {
  ReferencePoints points;
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 5; ++i) points.push_back({i / 4.0, j / 4.0, k / 4.0});
  return points;
}

class HexahedraCutter {
public:
  explicit HexahedraCutter(const GridField& coarse) : coarse_(coarse), new_nodes_(coarse, lattice_points()) {}

  GridField cut() {
    for (std::size_t c = 0; c < coarse_.grid.n_cells(); ++c) cut(c);
    // Faces keep their number: part p of a cell is at the low or the high end of each axis as its bits say.
    for (const auto& face : coarse_.grid.boundary)
      for (int part = 0; part < 8; ++part)
        if ((part >> (face.face / 2) & 1) == face.face % 2)
          fine_.grid.boundary.push_back({8 * face.cell + part, face.face, face.boundary_id});
    new_nodes_.add_to(fine_);
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
    const auto [known, is_new] = names_.try_emplace(name_of(at, nodes), new_nodes_.next());
    if (is_new) new_nodes_.append(nodes, place);
    return known->second;
  }

  const GridField& coarse_;
  NewNodes new_nodes_;
  std::map<Name, std::int32_t> names_;
  GridField fine_;
};

}  // namespace

GridField cut_hexahedra(const GridField& coarse) {
  return HexahedraCutter(coarse).cut();
}

}  // namespace fem
