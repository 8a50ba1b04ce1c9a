/// Meshes that the verification cases make themselves: blocks of cells mapped from the unit cube.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fem/base/values/coarse_mesh.h"

namespace verification {

using Point = Eigen::Vector3d;

/// Boundary groups of a block: the ends of the cube's three directions. Its volume group is block_volume.
enum Side : int { begin_1 = 1, end_1, begin_2, end_2, begin_3, end_3 };
inline constexpr int block_volume = 7;

/// cells[d] cells along direction d of the unit cube; the map keeps right-handedness. Several volume groups
/// are for hexahedra only, and so is a closed ring: direction 2 ends where it begins, without sides.
struct Block {
  std::array<int, 3> cells{{1, 1, 1}};
  std::function<Point(const Point&)> map;
  std::function<int(const std::array<int, 3>&)> volume{};  ///< of a cell; none: block_volume
  bool is_ring = false;
};

/// Linear hexahedra, corners in gmsh's order; faces by their corners, with their boundary group.
struct HexahedraMesh {
  std::vector<Point> nodes;
  std::vector<std::array<int, 8>> cells;
  std::vector<std::pair<std::array<int, 4>, int>> faces;
  std::vector<int> volumes{};  ///< of the cells; none: block_volume
};
HexahedraMesh hexahedra(const Block& block);

/// The cells of a body.
using Cells = std::shared_ptr<const fem::CoarseMesh>;
Cells cells_of(const HexahedraMesh& mesh);
Cells hexahedra_of(const Block& block);
/// Six tetrahedra of 10 nodes for each cell; all nodes where the map has them.
Cells tetrahedra_of(const Block& block);

}  // namespace verification
