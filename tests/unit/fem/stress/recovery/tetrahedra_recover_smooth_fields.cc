#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/stress/recovery/stress_recovery.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using fem_tests::Point;

const auto straight = [](const Point& x) { return x; };
const auto curved = [](const Point& x) {
  return Point(x[0] + 0.05 * std::sin(3 * x[1]), x[1] + 0.05 * std::sin(2 * x[2] + x[0]),
               x[2] + 0.04 * x[0] * x[1]);
};

/// Largest nodal error for a field known at the samples.
double recovery_error(const fem::Grid& grid, const std::vector<fem::BoundaryFace>& free,
                      const std::function<double(const Point&)>& field) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto samples = fem::make_samples(grid, free);
  fem::RowMajor values(samples.cell.size(), 1), nodal(grid.n_nodes, 1);
  for (std::size_t s = 0; s < samples.cell.size(); ++s) values(s, 0) = field(samples.position.col(s));
  fem::recover_by_patches(grid, cells, {}, samples, values, nodal);
  double worst = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    worst = std::max(worst, std::abs(nodal(i, 0) - field(Point(grid.position(i)))));
  return worst;
}

// n = 1 has no interior corner and corners with one cell of four samples: larger patches take over.
TEST(TetrahedraRecovery, QuadraticFieldsAreExact) {
  const auto field = [](const Point& x) {
    return 1 + x[0] - 2 * x[1] * x[1] + 3 * x[0] * x[1] - x[2] * x[2] + x[1] * x[2];
  };
  for (const int n : {1, 2, 3})
    for (const auto& grid :
         {fem_tests::tetrahedra_cube(n, straight), fem_tests::tetrahedra_cube(n, curved)}) {
      EXPECT_LT(recovery_error(grid, {}, field), 1e-11) << n;
      EXPECT_LT(recovery_error(grid, grid.boundary, field), 1e-11) << n;
    }
}

}  // namespace
