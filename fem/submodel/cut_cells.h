/// Quadratic cells cut into eight each. Internal to fem.
#pragma once

#include <vector>

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

// For cut_into_eight: by kind, and the values at new nodes below those at the old ones.
GridField cut_tetrahedra(const GridField& coarse);
GridField cut_hexahedra(const GridField& coarse);
RowMajor with_rows_below(const RowMajor& old_values, const std::vector<Eigen::RowVectorXd>& new_values);

}  // namespace fem
