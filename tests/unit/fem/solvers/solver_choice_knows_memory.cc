#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "fem/solvers/cost_prediction.h"
#include "fem/solvers/direct_solve.h"
#include "fem/solvers/iterative_solve.h"
#include "fem/solvers/solver_prediction.h"
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

/// Twenty such cells, one of them with an edge of `length`.
fem::Grid few_stretched(double length) {
  fem::Grid grid = one_cell(200'000);
  const auto compact = grid;
  const auto stretched = one_cell(200'000, length);
  for (int cell = 1; cell < 20; ++cell) {
    const auto& added = cell == 7 ? stretched : compact;
    for (const auto node : added.cell_nodes) grid.cell_nodes.push_back(27 * cell + node);
    grid.xyz_m.insert(grid.xyz_m.end(), added.xyz_m.begin(), added.xyz_m.end());
    grid.volume_id.push_back(1);
  }
  return grid;
}

fem::SolverReport choose(std::size_t n_nodes, const fem::SolverChoice& choice, double memory_bytes,
                         double length = 1) {
  return fem::choose_solver(one_cell(n_nodes, length), fem_tests::steel, 12, choice, memory_bytes);
}

std::string refusal(std::size_t n_nodes, const fem::SolverChoice& choice, double memory_bytes) {
  try {
    choose(n_nodes, choice, memory_bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

constexpr std::size_t n_nodes = 2'000'000;

TEST(SolverMemory, BodyThatFitsNeitherWayIsRefusedWithFiguresAndRemedy) {
  const auto report = choose(n_nodes, {}, 1e13);
  const double needed = report.predicted_iterative.bytes + fem::bytes_beside_solver(3 * n_nodes, 12);
  EXPECT_EQ(choose(n_nodes, {}, 1.01 * needed).used, fem::Solver::iterative);
  const auto text = refusal(n_nodes, {}, 0.99 * needed);
  for (const char* part :
       {"6000000 unknowns", "direct", "iterative", "predicted", "there are", "larger cells"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(SolverMemory, SolverAskedForIsRefusedOnlyIfNoMachineOfThatSizeCouldHoldIt) {
  fem::SolverChoice direct;
  direct.solver = fem::Solver::direct;
  const double bytes = choose(n_nodes, direct, 1e13).predicted_direct.bytes;
  EXPECT_EQ(choose(n_nodes, direct, 1.01 * bytes).used, fem::Solver::direct);
  EXPECT_NE(refusal(n_nodes, direct, 0.99 * bytes).find("asked for"), std::string::npos);
}

// The factors of thin bodies are smaller than predicted: their own analysis decides.
TEST(SolverMemory, StretchedBodiesAreLeftToTheAnalysisOfTheirMatrix) {
  EXPECT_EQ(choose(n_nodes, {}, 1e9, 40).used, fem::Solver::direct);
  EXPECT_NO_THROW(fem::refuse_large_factor(1e9, 1000, 1.1e9));
  EXPECT_THROW(fem::refuse_large_factor(1.1e9, 1000, 1e9), std::runtime_error);
}

TEST(SolverMemory, WhatGaveUpBeforeIsNotTriedAgain) {
  fem::SolverChoice choice;
  choice.gave_up_before = true;
  for (const auto solver : {fem::Solver::automatic, fem::Solver::iterative}) {
    choice.solver = solver;
    const auto report = choose(200'000, choice, 1e13);
    EXPECT_EQ(report.used, fem::Solver::direct);
    EXPECT_TRUE(report.gave_up);
    EXPECT_NE(report.reason.find("given up"), std::string::npos);
  }
}

TEST(SolverMemory, TrilinearLevelIsFactorisedOnlyWhileSmall) {
  EXPECT_EQ(choose(3'000, {}, 1e13).coarse_level, fem::CoarseLevel::factorised);
  EXPECT_EQ(choose(n_nodes, {}, 1e13).coarse_level, fem::CoarseLevel::aggregated);
  fem::SolverChoice choice;
  choice.coarse_level = fem::CoarseLevel::factorised;
  EXPECT_EQ(choose(n_nodes, choice, 1e13).coarse_level, fem::CoarseLevel::factorised);
}

// Four vectors of doubles and four of floats for 4 million unknowns: below 2 GB.
TEST(SolverMemory, BlocksOfLoadCasesAreBounded) {
  EXPECT_EQ(fem::loads_per_block(100'000), 16u);
  EXPECT_EQ(fem::loads_per_block(4'000'000), 8u);
  EXPECT_EQ(fem::loads_per_block(100'000'000), 4u);
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

// Cells of middling stretch take more iterations than is known: the factor has to be twice as expensive.
TEST(FactorSize, DecidesWhereCellsAreOfMiddlingStretch) {
  auto report = fem::choose_solver(few_stretched(18), fem_tests::steel, 12, {}, 1e13);
  EXPECT_EQ(report.used, fem::Solver::direct);
  ASSERT_TRUE(report.by_analysis);
  const double iterative_s = report.predicted_iterative.seconds;
  fem::FactorSize factor{600'000, 1e8, 0, 1e9};
  const auto with_seconds = [&](double seconds) {
    const double rest_s = fem::predict_direct(factor, 12).seconds;
    auto expensive = factor;
    expensive.flops = (seconds - rest_s) / 3.5e-11;
    EXPECT_NEAR(fem::predict_direct(expensive, 12).seconds, seconds, 1e-9 * seconds);
    return fem::is_too_expensive(expensive, report, 12);
  };
  EXPECT_TRUE(with_seconds(2.1 * iterative_s + 1));
  EXPECT_FALSE(with_seconds(1.9 * iterative_s + 1));
  report.by_analysis = false;
  EXPECT_FALSE(with_seconds(100 * iterative_s));
}

TEST(FactorSize, DoesNotDecideElsewhere) {
  const auto by_analysis = [](const fem::Grid& grid, const fem::SolverChoice& choice = {},
                              const fem::Material& material = fem_tests::steel) {
    return fem::choose_solver(grid, material, 12, choice, 1e13).by_analysis;
  };
  EXPECT_TRUE(by_analysis(few_stretched(18)));
  EXPECT_FALSE(by_analysis(few_stretched(3))) << "compact: decided without it";
  EXPECT_FALSE(by_analysis(few_stretched(40))) << "the iteration may not end";
  EXPECT_FALSE(by_analysis(one_cell(200'000, 18))) << "all cells are stretched";
  fem::SolverChoice choice;
  choice.solver = fem::Solver::direct;
  EXPECT_FALSE(by_analysis(few_stretched(18), choice)) << "asked for";
  choice = {};
  choice.gave_up_before = true;
  EXPECT_FALSE(by_analysis(few_stretched(18), choice));
  EXPECT_FALSE(by_analysis(few_stretched(18), {}, fem::Material{206e9, 0.4999, 7850}));
}

// What does not fit as a factor is iterated rather than refused, unless that cannot be hoped to end.
TEST(SolverMemory, StretchedBodiesMayBeIteratedWhereTheFactorDoesNotFit) {
  const auto may = [](const fem::Grid& grid, double memory_bytes = 1e13, const fem::SolverChoice& choice = {},
                      const fem::Material& material = fem_tests::steel) {
    const auto report = fem::choose_solver(grid, material, 12, choice, 1e13);
    EXPECT_EQ(report.used, fem::Solver::direct);
    return fem::may_be_iterated(grid, material, choice, report, memory_bytes);
  };
  EXPECT_TRUE(may(few_stretched(40)));
  EXPECT_FALSE(may(one_cell(200'000, 40))) << "all cells are stretched";
  EXPECT_FALSE(may(few_stretched(40), 1e6)) << "does not fit either";
  EXPECT_FALSE(may(few_stretched(40), 1e13, {}, {206e9, 0.4999, 7850}));
  fem::SolverChoice choice;
  choice.gave_up_before = true;
  EXPECT_FALSE(may(few_stretched(40), 1e13, choice));
  choice = {};
  choice.solver = fem::Solver::direct;
  EXPECT_FALSE(may(few_stretched(40), 1e13, choice)) << "asked for";
}

// Cells too long for the smoother stay so on a finer mesh, however many they are.
TEST(FactorSize, FinerMeshesOfStretchedCellsStayDirect) {
  for (const double length : {3.0, 40.0}) {
    auto at_hand = choose(50'000, {}, 1e13, length);
    const auto finer = fem::predict_solver(at_hand, 6'000'000, 2, 12, {});
    EXPECT_EQ(finer.used, length < 12 ? fem::Solver::iterative : fem::Solver::direct) << length;
  }
}

}  // namespace
