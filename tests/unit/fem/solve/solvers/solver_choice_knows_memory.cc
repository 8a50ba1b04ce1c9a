#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "fem/base/values/errors.h"
#include "fem/solve/solvers/cost_prediction.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/solve/solvers/solver_prediction.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

/// One cell of degree 2, edges 1, 1 and `length`, in a mesh that claims so many nodes.
fem::Grid one_cell(std::size_t n_nodes, double length = 1) {
  fem::Grid grid;
  grid.n_nodes = n_nodes;
  for (int i = 0; i < 27; ++i) {
    grid.cell_nodes.push_back(i);
    for (const double x : {0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * length * (i / 9)}) grid.xyz_m.push_back(x);
  }
  grid.volume_id.push_back(1);
  return grid;
}

std::string refusal(const std::function<void()>& choose) {
  try {
    choose();
  } catch (const fem::DoesNotFit& error) {
    return error.what();
  }
  return "";
}

constexpr std::size_t n_nodes = 2'000'000;

TEST(SolverMemory, IterationTakesOverWhereTheFactorDoesNotFit) {
  auto report = fem::choose_solver(one_cell(n_nodes), 12, {}, 1e9);
  EXPECT_EQ(report.used, fem::Solver::direct) << "its analysis decides";
  EXPECT_TRUE(fem::may_turn_to_iteration({}, report));
  EXPECT_FALSE(fem::may_turn_to_iteration({fem::Solver::direct}, report)) << "asked for";
  const double needed = report.predicted_iterative.bytes;
  const auto text = refusal([&] { fem::turn_to_iteration(3 * n_nodes, 0.99 * needed, report); });
  for (const char* part : {"6000000 unknowns", "iteration needs", "are left", "larger cells"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  EXPECT_EQ(report.used, fem::Solver::direct);
  fem::turn_to_iteration(3 * n_nodes, 1.01 * needed, report);
  EXPECT_EQ(report.used, fem::Solver::iterative);
  EXPECT_EQ(report.reason, "the factor does not fit into memory");
}

TEST(SolverMemory, IterationAskedForIsRefusedIfItDoesNotFit) {
  const fem::SolverChoice iterative{fem::Solver::iterative};
  const double bytes = fem::choose_solver(one_cell(n_nodes), 12, iterative, 1e13).predicted_iterative.bytes;
  EXPECT_EQ(refusal([&] { fem::choose_solver(one_cell(n_nodes), 12, iterative, 1.01 * bytes); }), "");
  EXPECT_NE(refusal([&] { fem::choose_solver(one_cell(n_nodes), 12, iterative, 0.99 * bytes); }), "");
}

TEST(SolverMemory, LargeFactorsAreRefused) {
  EXPECT_NO_THROW(fem::refuse_large_factor(1e9, 1000, 1.1e9));
  EXPECT_THROW(fem::refuse_large_factor(1.1e9, 1000, 1e9), fem::DoesNotFit);
}

// The matrix of one cell is full: column j of its factor has n - j entries, and takes as many squared flops.
TEST(FactorSize, OfAFullMatrix) {
  const auto cell = one_cell(27);
  const auto size = fem::analyse_factor(cell, fem::cells_of_nodes(cell));
  constexpr double n = 81;
  EXPECT_EQ(size.n_dofs, std::size_t(n));
  EXPECT_EQ(size.flops, n * (n + 1) * (2 * n + 1) / 6);
  EXPECT_GE(size.entries, n * (n + 1) / 2);
  EXPECT_LE(size.entries, n * n);
  EXPECT_GE(size.bytes, 8 * size.entries);
}

// Seconds follow from what was analysed: two bodies with as many unknowns need not cost the same.
TEST(FactorSize, TellsSecondsAndBytes) {
  const fem::FactorSize thin{100'000, 5e7, 4e10, 5e8}, compact{100'000, 2e8, 5e11, 2e9};
  EXPECT_LT(3 * fem::predict_direct(thin, 12).seconds, fem::predict_direct(compact, 12).seconds);
  EXPECT_EQ(fem::predict_direct(compact, 12).bytes, compact.bytes);
  const auto larger = fem::scaled(compact, 200'000);
  EXPECT_EQ(larger.n_dofs, 200'000u);
  EXPECT_DOUBLE_EQ(larger.flops, 4 * compact.flops);
}

// Of a finer mesh the factor grows beyond any machine's memory, and the iteration is foreseen.
TEST(FactorSize, GrowsUntilTheIterationIsForeseen) {
  auto at_hand = fem::choose_solver(one_cell(50'000), 12, {}, 1e13);
  at_hand.factor = {150'000, 2e8, 5e11, 2e9};
  EXPECT_EQ(fem::predict_solver(at_hand, 100'000, 2, 12, {}).used, fem::Solver::direct);
  EXPECT_EQ(fem::predict_solver(at_hand, 1'000'000'000, 2, 12, {}).used, fem::Solver::iterative);
  EXPECT_EQ(fem::predict_solver(at_hand, 1'000'000'000, 2, 12, {fem::Solver::direct}).used,
            fem::Solver::direct);
}

}  // namespace
