/// Quadratic cells cut into eight each. Internal to fem.
#pragma once

#include "fem/mesh/grid.h"
#include "fem/stress/cell_stress.h"

namespace fem {

/// A grid and a field of its nodes.
struct GridField {
  Grid grid;
  RowMajor field;  ///< n_nodes x columns
};

/// Positions and field are the cells' own polynomials, so that neither shape nor field changes; the old nodes
/// keep their numbers, the eight parts of a cell follow each other, boundary faces keep their groups.
/// Hexahedra are halved in each direction. Of a tetrahedron there is one part at each corner, and four stand
/// around the shortest diagonal of the octahedron between them.
/// @param coarse  of degree 2
/// @throws std::invalid_argument if it is not
GridField cut_into_eight(const GridField& coarse);

// By kind, for cut_into_eight.
GridField cut_tetrahedra(const GridField& coarse);
GridField cut_hexahedra(const GridField& coarse);

}  // namespace fem
