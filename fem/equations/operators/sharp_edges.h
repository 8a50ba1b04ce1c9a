/// Sharp edges that turn into the material: displacement is one there, stress is not. Internal to fem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// The mesh with the nodes of sharp edges once for each side: what stress lives on.
struct SplitGrid {
  Grid grid;                       ///< the given nodes first, for one side; then the others
  std::vector<std::int32_t> copy;  ///< given nodes that the further nodes are copies of, in their order
};

/// Splits the nodes of re-entrant sharp edges of tetrahedra: once for each side of the edge. Stress has no
/// bound on such an edge, and on its two faces it points along either: a mean of both would be a fraction of
/// them, and a fit through samples on both faces has no traction across either of them on the edge itself, as
/// if the notch were relieved. A cell at the edge belongs to the side whose face it has or is nearest to.
/// Edges are those whose boundary faces have outward normals more than 60 degrees apart, turned into the
/// material, or 25 degrees between two boundary groups, by the curved faces; a node at which a single edge
/// ends has its two sides too.
/// @param no_surface  boundary group that is no surface of the body: the rim of a submodel
/// @return no copies of hexahedra, and of bodies without such edges
SplitGrid split_at_sharp_edges(const Grid& grid, const CellsOfNodes& cells,
                               std::optional<int> no_surface = std::nullopt);

}  // namespace fem
