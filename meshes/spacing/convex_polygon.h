/// Distance of convex figures in the plane.
#pragma once

#include <array>
#include <vector>

namespace meshes {

/// @param a, b corners in order, in m; a single one is a point
/// @return smallest distance in m; 0 if they overlap
double convex_distance(const std::vector<std::array<double, 2>>& a,
                       const std::vector<std::array<double, 2>>& b);

}  // namespace meshes
