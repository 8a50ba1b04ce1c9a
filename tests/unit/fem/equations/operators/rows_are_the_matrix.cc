#include <gtest/gtest.h>

#include "fem/equations/operators/stiffness_rows.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/ranks/deal_out_cells.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

fem::Grid refined_rod() {
  auto rod = fem_tests::rod(8);
  rod.body = fem_tests::refined_at_random(rod.body, 2, 0.05, 1);
  return fem::make_grid(rod.body);
}

/// K x of the rows that each of n ranks has, at the nodes of the body; zero at hanging ones.
Eigen::VectorXd product(const fem::Grid& grid, int n_ranks, const Eigen::VectorXd& x,
                        const std::vector<std::int64_t>& held) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto ranks = fem::ranks_of_nodes(grid, fem::deal_out_cells(grid, n_ranks));
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int r = 0; r < n_ranks; ++r) {
    const fem::RowPlan plan(grid, ranks, r, n_ranks);
    std::vector<std::int32_t> node_of_row(grid.n_nodes, -1);
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      if (plan.row[i] >= 0) node_of_row[std::size_t(plan.row[i])] = std::int32_t(i);
    const auto rows = fem::stiffness_rows(grid, cells, fem::lame(fem_tests::steel), plan, held);
    EXPECT_EQ(rows.begin.size(), 3 * plan.own.size() + 1);
    for (std::size_t i = 0; i + 1 < rows.begin.size(); ++i)
      for (auto k = std::size_t(rows.begin[i]); k < std::size_t(rows.begin[i + 1]); ++k) {
        const auto column = std::size_t(rows.column[k]);
        if (k > std::size_t(rows.begin[i])) {
          EXPECT_GT(rows.column[k], rows.column[k - 1]);
        }
        y[3 * Eigen::Index(plan.own[i / 3]) + Eigen::Index(i % 3)] +=
            rows.value[k] * x[3 * Eigen::Index(node_of_row[column / 3]) + Eigen::Index(column % 3)];
      }
  }
  return y;
}

// Turns red: cells of other ranks left out, a transposed block not transposed.
TEST(StiffnessRows, AreThoseOfTheMatrixOnAnyNumberOfRanks) {
  const auto grid = refined_rod();
  ASSERT_GT(grid.hanging.n(), 100u);
  Eigen::VectorXd x = Eigen::VectorXd::Random(3 * Eigen::Index(grid.n_nodes));
  for (const auto node : grid.hanging.node) x.segment<3>(3 * Eigen::Index(node)).setZero();
  const Eigen::VectorXd wanted = fem_tests::stiffness_times(grid, x);
  for (const int n : {1, 2, 3}) {
    const Eigen::VectorXd y = product(grid, n, x, {});
    EXPECT_LT((y - wanted).lpNorm<Eigen::Infinity>(), 1e-13 * wanted.lpNorm<Eigen::Infinity>()) << n;
  }
}

TEST(StiffnessRows, KeepTheDiagonalOfHeldUnknowns) {
  const auto grid = refined_rod();
  const fem::RowPlan plan(grid, std::vector<int>(grid.n_nodes, 0), 0, 1);
  const Eigen::Index held = 3 * Eigen::Index(plan.own[plan.own.size() / 2]) + 1;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3 * Eigen::Index(grid.n_nodes));
  x[held] = 1;
  Eigen::VectorXd y = product(grid, 2, x, {held});
  EXPECT_GT(y[held], 0);
  y[held] = 0;
  EXPECT_EQ(y.norm(), 0) << "its column";
  for (const auto node : plan.own) x.segment<3>(3 * Eigen::Index(node)).setOnes();
  x[held] = 0;
  EXPECT_EQ(product(grid, 2, x, {held})[held], 0) << "its row";
}

// Turns red: the first share as large as the others, or parts of a share by the number of shares alone.
TEST(DealOutCells, TheFirstShareHasWhatIsAskedAndTheOthersAreAlike) {
  const auto grid = refined_rod();
  for (const int n : {2, 3, 4, 7})
    for (const double first : {1.0, 0.4, 0.05}) {
      std::vector<double> cells(std::size_t(n), 0.0);
      for (const int share : fem::deal_out_cells(grid, n, first)) ++cells[std::size_t(share)];
      const double each = double(grid.n_cells()) / (first + n - 1);
      const double rounding = 2;  // half a cell at each of at most four halvings
      EXPECT_NEAR(cells[0], first * each, rounding) << n << " shares";
      for (int share = 1; share < n; ++share) EXPECT_NEAR(cells[std::size_t(share)], each, rounding);
    }
}

}  // namespace
