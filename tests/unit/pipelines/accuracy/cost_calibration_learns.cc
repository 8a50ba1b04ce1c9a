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
    EXPECT_NE(read_calibration(directory / "costs.json").fault.find("costs.json: is damaged"),
              std::string::npos)
        << text;
  }
  EXPECT_EQ(read_calibration(directory / "nothing.json").fault, "");
  learn_cost({}, fem::Solver::direct, 2, 2);
}

// One digit changed is another factor, which the next forecast would believe.
TEST(CostCalibration, BelievesNoChangedDigit) {
  const results_test::Directory directory;
  const auto file = directory / "costs.json";
  learn_cost(file, fem::Solver::direct, 3, 0.7);
  const auto kept = read_calibration(file);
  EXPECT_EQ(kept.fault, "");
  const auto whole = results_test::bytes(file);
  int n_digits = 0, n_refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] < '0' || whole[i] > '9') continue;
    auto changed = whole;
    changed[i] = whole[i] == '9' ? '8' : char(whole[i] + 1);
    std::ofstream(file) << changed;
    ++n_digits;
    const auto read = read_calibration(file);
    if (!read.fault.empty())
      EXPECT_EQ(read.n_runs, 0) << i;
    else  // a last digit that reads back to the same number
      EXPECT_TRUE(read.direct == kept.direct && read.superposition == kept.superposition) << i;
    n_refused += read.fault.empty() ? 0 : 1;
  }
  EXPECT_GT(n_digits, 30);
  EXPECT_GT(n_refused, n_digits - 5);
  std::ofstream(file) << "{}";
  learn_cost(file, fem::Solver::direct, 3, 0.7);  // made anew
  EXPECT_EQ(read_calibration(file).n_runs, 1);
}
