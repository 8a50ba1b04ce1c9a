/// Grids of quadratic tetrahedra without a file: what the tests of tetrahedra share.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <memory>

#include "fem/base/values/coarse_mesh.h"
#include "fem/mesh/grid/grid.h"

namespace fem_tests {

using Point = Eigen::Vector3d;

/// n^3 boxes of the unit cube in six tetrahedra each, all nodes moved by `bend`: edges become curved.
/// Boundary ids 1 to 6 are x = 0, x = 1, y = 0, y = 1, z = 0, z = 1; the volume is 7.
fem::Grid tetrahedra_cube(int n, const std::function<Point(const Point&)>& bend);

/// The same with n[0] x n[1] x n[2] boxes.
fem::Grid tetrahedra_block(const std::array<int, 3>& n, const std::function<Point(const Point&)>& bend);

/// The cube with straight edges and corners inside the cube moved at random by up to a fifth of a box.
fem::Grid irregular_cube(int n);

/// The grid as a mesher would hand it over, behind a point that no cell has.
std::shared_ptr<const fem::CoarseMesh> cells_of(const fem::Grid& grid);

}  // namespace fem_tests
