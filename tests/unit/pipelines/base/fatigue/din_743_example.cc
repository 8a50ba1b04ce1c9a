/// A published exercise: shoulder D = 100, d = 84, r = 4 mm of 50CrMo4, case 1, S = 2.373 (exam MEL1 2024W
/// no. 1, in the tests of hanslhansl/engineering-standards-library). Turns red: beta without the support
/// number, sigma_S instead of its part at d_eff, psi with sigma_B alone.
#include "pipelines/base/fatigue/din_743.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace pipelines;

DinShaft shoulder() {
  // K_1 of quenched and tempered steel at d_eff = 100: 1 - 0.26 lg(100/16), and 0.34 of the yield strength.
  const double lg = std::log10(100.0 / 16);
  DinShaft shaft;
  shaft.tensile_strength_Pa = (1 - 0.26 * lg) * 1100e6;
  shaft.yield_strength_Pa = (1 - 0.34 * lg) * 900e6;
  shaft.diameter_m = 0.084;
  shaft.roughness_m = 10e-6;
  // Shape factor of the shoulder in bending, 743-2 table 2, and G' = 2.3 (1 + phi) / r.
  const double r = 4, t = 8, d = 84, D = 100;
  shaft.shape_factor.bending = 1 + 1 / std::sqrt(0.62 * r / t + 2 * 5.8 * r / d * std::pow(1 + 2 * r / d, 2) +
                                                 0.2 * std::pow(r / t, 3) * d / D);
  shaft.gradient_1_m.bending = 2.3 * (1 + 1 / (4 * std::sqrt(t / r) + 2)) / 4e-3;
  return shaft;
}

DinLoad load_of_exercise() {
  DinLoad load;
  load.mean_Pa = {80e6, 400e6, 120e6};
  load.amplitude_Pa.bending = 50e6;
  load.load_case = DinLoadCase::constant_mean;
  return load;
}

TEST(Din743, ExerciseOfAShoulder) {
  const DinSafety safety = din_743_safety(shoulder(), load_of_exercise());
  EXPECT_NEAR(safety.fatigue, 2.373, 0.0005);  // the exercise's digits
  EXPECT_NEAR(safety.mean_equivalent_Pa, std::sqrt(480.0 * 480 + 3 * 120 * 120) * 1e6, 1);
}

TEST(Din743, CaseTwoIsTheSameRatio) {
  DinLoad load = load_of_exercise();
  load.load_case = DinLoadCase::constant_ratio;
  const DinSafety at = din_743_safety(shoulder(), load);
  // Scaled by its safety, the load lies on the line: safety 1 again, in both cases.
  for (DinTriple* t : {&load.mean_Pa, &load.amplitude_Pa})
    for (double* value : {&t->tension, &t->bending, &t->torsion}) *value *= at.fatigue;
  EXPECT_NEAR(din_743_safety(shoulder(), load).fatigue, 1, 1e-12);
  load.load_case = DinLoadCase::constant_mean;
  EXPECT_NEAR(din_743_safety(shoulder(), load).fatigue, 1, 1e-12);
  EXPECT_LT(at.fatigue, 2.373);
}

// Reversed torsion with static bending: what bending alternates by, from nothing on, moves the safety by
// little. By the standard's letter 1 Pa of it would count the mean a second time. From a hundredth of the
// equivalent amplitude on the letter holds: sigma_a / sigma_ADK is the larger of (sigma_a + psi sigma_mv) /
// sigma_WK and (sigma_a + sigma_mv) / sigma_FK.
TEST(Din743, ALittleBendingIsNoJump) {
  DinLoad load;
  load.mean_Pa.bending = 140e6;
  load.amplitude_Pa.torsion = 11e6;
  const double without = din_743_safety(shoulder(), load).fatigue;
  for (const double little_Pa : {1e-8, 1.0, 5e3}) {
    load.amplitude_Pa.bending = little_Pa;
    EXPECT_NEAR(din_743_safety(shoulder(), load).fatigue, without, 1e-3 * without) << little_Pa;
  }
  load.amplitude_Pa.bending = 0.011 * std::sqrt(3.0) * 11e6;
  const auto s = din_743_safety(shoulder(), load);
  const auto share = [](double amplitude, double mean, double psi, double reversed, double yield) {
    return std::max((amplitude + psi * mean) / reversed, (amplitude + mean) / yield);
  };
  const double bending = share(load.amplitude_Pa.bending, 140e6, s.sensitivity.bending, s.reversed_Pa.bending,
                               s.yield_Pa.bending);
  const double torsion =
      share(11e6, 140e6 / std::sqrt(3.0), s.sensitivity.torsion, s.reversed_Pa.torsion, s.yield_Pa.torsion);
  EXPECT_NEAR(s.fatigue, 1 / std::hypot(bending, torsion), 1e-12);
  EXPECT_LT(s.fatigue, 0.99 * without);
}

TEST(Din743, LimitsAndRefusals) {
  EXPECT_EQ(din_size_factor(5e-3), 1);
  EXPECT_NEAR(din_size_factor(0.3), 0.8, 1e-15);
  EXPECT_EQ(din_743_safety(shoulder(), {}).fatigue, std::numeric_limits<double>::infinity());
  DinShaft wrong = shoulder();
  wrong.shape_factor.torsion = 0.5;
  EXPECT_THROW(din_743_safety(wrong, {}), std::invalid_argument);
  DinLoad negative;
  negative.amplitude_Pa.bending = -1;
  EXPECT_THROW(din_743_safety(shoulder(), negative), std::invalid_argument);
}

}  // namespace
