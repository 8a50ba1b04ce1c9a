/// Quadratic tetrahedra cut into eight each. Internal to fem.
#pragma once

#include "fem/mesh/grid.h"
#include "fem/stress/cell_stress.h"

namespace fem {

/// A grid and a field of its nodes.
struct GridField {
  Grid grid;
  RowMajor field;  ///< n_nodes x columns
};

/// Every cell becomes eight: one at each corner, four around the shortest diagonal of the octahedron between
/// them. Positions and field are the cells' own polynomials, so that neither shape nor field changes; the old
/// nodes keep their numbers. Boundary faces keep their groups.
/// @param coarse  quadratic tetrahedra
GridField cut_into_eight(const GridField& coarse);

}  // namespace fem
