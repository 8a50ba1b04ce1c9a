/// Quality of linear hexahedra.
#pragma once

#include "meshes/body_mesh.h"
#include "meshes/hex_mesh.h"

namespace meshes {

/// Scaled Jacobian of one cell: the smallest, over its 8 corners, of the determinant of the three unit
/// vectors along the edges that leave the corner. 1 for a brick; 0 or less if a corner is turned inside
/// out or flat.
double scaled_jacobian(const HexMesh& mesh, const Hex& hex);

/// Longest of the 12 edges over the shortest.
double aspect(const HexMesh& mesh, const Hex& hex);

/// Counts, the largest aspect, the smallest and the median scaled Jacobian, and where the worst cell lies.
MeshQuality measure_quality(const HexMesh& mesh);

}  // namespace meshes
