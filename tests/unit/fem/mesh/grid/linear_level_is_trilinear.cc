#include "fem/mesh/grid/linear_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/mesh/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

/// Interpolates a linear function of the place from the vertices and compares it at all nodes with a row.
/// @return the largest difference over the largest coordinate
double off(const fem::Grid& grid, const fem::LinearLevel& level) {
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    if (level.begin[i] == level.begin[i + 1]) continue;
    for (int d = 0; d < 3; ++d) {
      double sum = 0;
      for (auto k = level.begin[i]; k < level.begin[i + 1]; ++k)
        sum += level.weight[k] * grid.position(level.vertex[k])[d];
      worst = std::max(worst, std::abs(sum - grid.position(std::int32_t(i))[d]));
      size = std::max(size, std::abs(sum));
    }
  }
  return worst / size;
}

// A straight block cut locally twice: corners hang in chains. Turns red: hanging corners as vertices, parents
// in the smaller of two cells.
TEST(LinearLevel, InterpolatesLinearFunctionsOnRefinedHexahedra) {
  auto rod = fem_tests::rod(8);
  rod.body.cylinders.clear();
  rod.body = fem_tests::refined_at_random(rod.body, 2, 0.1, 1);
  const auto grid = fem::make_grid(rod.body);
  ASSERT_GT(grid.hanging.n(), 100u);
  const auto level = fem::make_linear_level(grid);
  EXPECT_LT(off(grid, level), 1e-14);
  for (const auto node : grid.hanging.node) EXPECT_FALSE(level.is_vertex(node));
}

TEST(LinearLevel, OfTetrahedraHasTheirCorners) {
  const auto grid = fem_tests::irregular_cube(3);
  const auto level = fem::make_linear_level(grid);
  EXPECT_LT(off(grid, level), 1e-14);
  std::size_t n = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) n += level.is_vertex(std::int32_t(i));
  EXPECT_EQ(n, 4u * 4 * 4);
}

}  // namespace
