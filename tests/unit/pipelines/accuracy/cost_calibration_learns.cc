#include "pipelines/accuracy/cost_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

// A machine three times slower than the prediction's: half of the way each run, in logarithms, so that after
// n runs 3^(1 - 2^-n) is learnt; the other solver is not touched.
TEST(CostCalibration, MovesHalfOfTheWayWithEveryRun) {
  const results_test::Directory directory;
  const auto file = directory / "cache/costs.json";
  EXPECT_EQ(read_calibration(file).n_runs, 0);
  for (int run = 1; run <= 5; ++run) {
    learn_cost(file, fem::Solver::direct, 3, 0);
    const auto kept = read_calibration(file);
    EXPECT_NEAR(kept.direct, std::pow(3, 1 - std::pow(2, -run)), 1e-12);
    EXPECT_EQ(kept.n_runs, run);
    EXPECT_EQ(kept.iterative, 1);
    EXPECT_EQ(kept.superposition, 1);
  }
  learn_cost(file, fem::Solver::iterative, 0, 0.25);
  EXPECT_NEAR(read_calibration(file).superposition, 0.5, 1e-15);
}

// Nonsense in the cache, as a crash or another hand leaves it, is no failure.
TEST(CostCalibration, SurvivesARuinedFile) {
  const results_test::Directory directory;
  for (const char* text : {"", "{", "[1, 2]", "{\"direct\": \"fast\"}", "{\"direct\": -2, \"runs\": 1}"}) {
    std::ofstream(directory / "costs.json") << text;
    EXPECT_EQ(read_calibration(directory / "costs.json").direct, 1) << text;
  }
  learn_cost({}, fem::Solver::direct, 2, 2);
}
