/// Where materials meet: displacement is one there, stress is not. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid.h"
#include "fem/operators/cell_materials.h"

namespace fem {

/// The mesh with the nodes of interfaces once for each material there: what stress lives on.
struct SplitGrid {
  Grid grid;                       ///< the given nodes first, for one of their materials; then the others
  std::vector<std::int32_t> copy;  ///< given nodes that the further nodes are copies of, in their order
};

/// @return with grid.interfaces: the faces between materials, from both sides
SplitGrid split_at_interfaces(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials);

/// The body's faces between materials, and their nodes apart; the grid as it is if there is one material.
Grid grid_of_stress(const Grid& grid, const CellMaterials& materials);

}  // namespace fem
