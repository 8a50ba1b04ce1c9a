/// Quality of linear hexahedra.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"
#include "meshes/values/hex_mesh.h"

namespace meshes {

/// Scaled Jacobian of one cell: the smallest, over its 8 corners, of the determinant of the three unit
/// vectors along the edges that leave the corner. 1 for a brick; 0 or less if a corner is turned inside
/// out or flat.
double scaled_jacobian(const HexMesh& mesh, const Hex& hex);

/// Longest of the 12 edges over the shortest.
double aspect(const HexMesh& mesh, const Hex& hex);

/// Sets the smallest and the median scaled Jacobian, and the middle of the worst cell's corners.
/// @param values      values of all cells
/// @param corners_of  corner points of a cell
void summarise(std::vector<double> values, const std::function<std::vector<Point>(std::size_t)>& corners_of,
               MeshQuality& quality);

/// @param mesh, remedy  words for the message, which names value and place
/// @throws MeshRefused if the smallest scaled Jacobian is less than wanted
void require_quality(const MeshQuality& quality, double wanted, const std::string& mesh,
                     const std::string& remedy);

/// Counts, the largest aspect, the smallest and the median scaled Jacobian, and where the worst cell lies.
MeshQuality measure_quality(const HexMesh& mesh);

}  // namespace meshes
