#include <gtest/gtest.h>

#include <cmath>

#include "fem/solvers/solver_prediction.h"
#include "fem/values/cost_constants.h"
#include "tests/benchmarks/solvers/cost_fit.h"

namespace {

constexpr std::size_t n_fitted_loads = 12;

/// A machine that is `slower` times as slow as predicted, and takes so much more memory.
measure::SolverRow predicted_row(std::size_t n_dofs, double aspect, fem::CoarseLevel level, double slower) {
  measure::SolverRow row;
  row.n_dofs = n_dofs;
  row.aspect = aspect;
  row.coarse_level = level == fem::CoarseLevel::aggregated ? measure::aggregates : measure::coarse_factor;
  const double more = level == fem::CoarseLevel::aggregated ? fem::cost::aggregates_more_iterations : 1;
  row.n_iterations =
      int(std::lround(more * (fem::cost::iterations_first + fem::cost::iterations_per_aspect * aspect)));
  const auto iterative = fem::predict_iterative(n_dofs, 2, n_fitted_loads, aspect, level);
  const auto direct = fem::predict_direct(n_dofs, n_fitted_loads);
  row.iterative.cpu_s = 2 * slower * iterative.seconds;
  row.iterative.bytes = iterative.bytes;
  row.direct.emplace();
  row.direct->cpu_s = 2 * slower * direct.seconds;
  row.direct->bytes = direct.bytes + 1e9;
  row.direct->bytes_before = 1e9;
  return row;
}

std::vector<measure::SolverRow> predicted_rows(double slower) {
  std::vector<measure::SolverRow> rows;
  for (const std::size_t n_dofs : {64'000, 232'000, 672'000})
    for (const double aspect : {2.0, 4.0, 6.0})  // 12.6, 17.2, 21.8 iterations
      for (const auto level : {fem::CoarseLevel::factorised, fem::CoarseLevel::aggregated})
        rows.push_back(predicted_row(n_dofs, aspect, level, slower));
  return rows;
}

}  // namespace

// Fed with what the formulas predict, the fit gives the table back: it knows the same formulas. Iterations
// are whole numbers, hence 5 %.
TEST(CostFit, FindsTheTableThatMadeTheRows) {
  const auto constants = measure::fit_costs(predicted_rows(1), n_fitted_loads);
  ASSERT_EQ(constants.size(), 7U);
  for (const auto& c : constants) EXPECT_NEAR(c.fitted, c.table, 0.05 * c.table) << c.name;
}

// Seconds of a machine three times as slow; what its factor and memory take stays.
TEST(CostFit, SeesASlowerMachine) {
  for (const auto& c : measure::fit_costs(predicted_rows(3), n_fitted_loads)) {
    if (c.name == "iteration_s_per_dof") {
      EXPECT_GT(c.fitted, 2.8 * c.table);
    }
    if (c.name == "direct_s_square") {
      EXPECT_NEAR(c.fitted, 3 * c.table, 0.1 * c.table);
    }
    if (c.name == "direct_bytes") {
      EXPECT_NEAR(c.fitted, c.table, 1e-9 * c.table);
    }
  }
}

// A factor of few flops is on one thread, whose seconds count whole.
TEST(CostFit, TakesSecondsByFlopFromTheFactor) {
  for (const bool shared : {false, true}) {
    auto row = predicted_row(232'000, 2, fem::CoarseLevel::aggregated, 1);
    row.factor = {232'000, 3e8, (shared ? 3.3 : 0.3) * fem::flops_worth_threads, 2.5e9};
    row.direct->cpu_s = (shared ? 2 : 1) * fem::predict_direct(row.factor, n_fitted_loads).seconds;
    std::size_t n_found = 0;
    for (const auto& c : measure::fit_costs({row}, n_fitted_loads)) {
      if (c.name.rfind("factor_s_per_flop", 0) != 0) continue;
      ++n_found;
      EXPECT_EQ(c.name, shared ? "factor_s_per_flop_shared" : "factor_s_per_flop_alone");
      EXPECT_NEAR(c.fitted, c.table, 1e-9 * c.table);
    }
    EXPECT_EQ(n_found, 1U);
  }
}
