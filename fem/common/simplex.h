/// Quadratic shape functions of the reference tetrahedron and triangle. Internal to fem.
#pragma once

#include <array>
#include <vector>

namespace fem {

/// One function: its value and its derivatives along the reference axes.
struct ShapeAt {
  double value = 0;
  std::array<double, 3> gradient{};
};

/// The 10 functions of the tetrahedron, or the 6 of the triangle (third coordinate not used), in the order of
/// grid.h.
std::vector<ShapeAt> quadratic_tetrahedron(const std::array<double, 3>& point);
std::vector<ShapeAt> quadratic_triangle(const std::array<double, 3>& point);

/// Reference points of the tetrahedron's 10 nodes.
std::vector<std::array<double, 3>> tetrahedron_nodes();

}  // namespace fem
