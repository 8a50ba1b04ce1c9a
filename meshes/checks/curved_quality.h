/// Quality of quadratic tetrahedra and linear hexahedra.
#pragma once

#include "meshes/values/body_mesh.h"

namespace meshes {

/// Scaled Jacobian of one cell. Tetrahedra: the smallest, over the 20 points of the cubic lattice of the
/// curved cell, of sqrt(2) det(dx/dxi) over the largest product of the three edge vectors that meet at a
/// corner of the cell tangent there; 1 for a regular tetrahedron, at most 0 if it is inverted somewhere.
/// (det is a cubic: 20 values determine it.) Hexahedra: as in quality.h.
double scaled_jacobian(const CellMesh& mesh, std::size_t cell);

/// Counts, the smallest and the median scaled Jacobian, where the worst cell lies, the largest aspect.
MeshQuality measure_quality(const CellMesh& mesh);

}  // namespace meshes
