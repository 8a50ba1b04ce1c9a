/// Meshes that are their own mirror image. Internal to fem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// A plane across a coordinate axis in which a mesh is its own mirror image. Faces of cells make up the
/// plane.
struct MirrorPlane {
  int axis = 2;
  double place_m = 0;              ///< along that axis
  std::vector<std::int32_t> node;  ///< the image of each node; of one in the plane itself
  std::vector<std::int32_t> cell;  ///< the image of each cell

  bool holds(std::int32_t of_node) const { return node[std::size_t(of_node)] == of_node; }
};

/// Across z, else x, else y. Nodes may be off by 1e-10 of the body's size.
std::optional<MirrorPlane> find_mirror_plane(const Grid& grid, const CellsOfNodes& cells);

}  // namespace fem
