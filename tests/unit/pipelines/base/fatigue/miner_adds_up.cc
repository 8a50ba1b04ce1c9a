/// S-N curves, Miner's sum and the factor for a wanted life.
/// Turns red: the second slope on the wrong side of the knee, damage below a fatigue limit, range for
/// amplitude.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "kinetics/series/load_spectrum.h"
#include "pipelines/base/fatigue/sn_curve.h"

namespace {

using namespace pipelines;

TEST(Miner, CurveBothWays) {
  const SnCurve endures{100, 1e6, 5, {}}, falls{100, 1e6, 5, 9};
  EXPECT_NEAR(*cycles_to_failure(endures, 200), 1e6 / 32, 1e-8);
  EXPECT_FALSE(cycles_to_failure(endures, 100).has_value());
  EXPECT_NEAR(*cycles_to_failure(falls, 50), 1e6 * 512, 1e-4);
  EXPECT_FALSE(cycles_to_failure(falls, 0).has_value());
  EXPECT_EQ(endured_amplitude_Pa(endures, 1e9), 100);
  for (const double amplitude : {30.0, 80.0, 130.0, 400.0})
    EXPECT_NEAR(endured_amplitude_Pa(falls, *cycles_to_failure(falls, amplitude)), amplitude, 1e-10);
  EXPECT_THROW(cycles_to_failure({0, 1e6, 5, {}}, 1), std::invalid_argument);
  EXPECT_THROW(cycles_to_failure({100, 1e6, 5, 4.0}, 1), std::invalid_argument);
}

// Shigley's example 6-9: S_e = 236, (f S_ut) = 0.844 690 at 1e3; 335.1 MPa lasts 68e3 cycles as printed.
TEST(Miner, LifeOfShigleys6_9) {
  const SnCurve curve{236, 1e6, 3 / std::log10(0.844 * 690 / 236), {}};
  EXPECT_NEAR(*cycles_to_failure(curve, 335.1), 68e3, 1e3);
}

TEST(Miner, TwoBlocksByHand) {
  const SnCurve curve{100, 1e6, 5, {}};
  const std::vector<StressBlock> blocks{{200, 1000}, {100 * std::pow(10, 0.2), 5000}, {90, 1e9}};
  EXPECT_NEAR(miner_damage(curve, blocks), 1000 * 32 / 1e6 + 5000 / 1e5, 1e-14);
}

// ASTM E1049, figure 6, in units of 100 MPa ranges; one slope: sum n (range/2)^k, by hand.
TEST(Miner, AstmE1049) {
  Eigen::ArrayXd series(9);
  series << -2, 1, -3, 5, -1, 3, -4, 4, -2;
  std::vector<StressBlock> blocks;
  for (const auto& cycle : kinetics::rainflow(series)) blocks.push_back({cycle.range / 2, cycle.count});
  const SnCurve curve{1, 1e3, 3, 3.0};
  const double by_hand = (0.5 * 27 + 1.5 * 64 + 0.5 * 216 + 512 + 0.5 * 729) / 8;
  EXPECT_NEAR(miner_damage(curve, blocks), by_hand / 1e3, 1e-14);
  EXPECT_NEAR(*life_factor(curve, blocks, 1), std::cbrt(1e3 / by_hand), 1e-13);
}

// The damage with the factor is the wanted one; just above, it is more.
TEST(Miner, LifeFactorIsARoot) {
  const std::vector<StressBlock> blocks{{300, 2}, {120, 40}, {120, 5}, {70, 900}, {5, 1e5}, {0, 7}};
  const auto damage_with = [&](const SnCurve& curve, double factor) {
    auto scaled = blocks;
    for (auto& block : scaled) block.amplitude_Pa *= factor;
    return miner_damage(curve, scaled);
  };
  for (const double repetitions : {1e-3, 1.0, 1e2, 1e4, 1e6, 1e12}) {
    const SnCurve falls{100, 1e6, 5, 9.0}, endures{100, 1e6, 5, {}};
    EXPECT_NEAR(repetitions * damage_with(falls, *life_factor(falls, blocks, repetitions)), 1, 1e-11)
        << repetitions;
    const double factor = *life_factor(endures, blocks, repetitions, 0.5);
    EXPECT_LE(repetitions * damage_with(endures, factor * (1 - 1e-12)), 0.5 * (1 + 1e-10)) << repetitions;
    EXPECT_GE(repetitions * damage_with(endures, factor * (1 + 1e-12)), 0.5 * (1 - 1e-10)) << repetitions;
  }
  EXPECT_NEAR(*life_factor({100, 1e6, 5, {}}, {{50, 1}}, 1e30), 2, 1e-12);  // for ever: knee / amplitude
  EXPECT_FALSE(life_factor({100, 1e6, 5, {}}, {}, 1).has_value());
  EXPECT_THROW(life_factor({100, 1e6, 5, {}}, {{-1, 1}}, 1), std::invalid_argument);
}

// Below the knee all endure, above it small cycles count by the one slope: with the factor the repetitions
// are endured, just above they are not. A part 1 % above its endurance is not far from a life for ever.
TEST(Miner, WhatEnduresTogetherHasTheFactorOfTheKnee) {
  const std::vector<StressBlock> blocks{{300, 2}, {120, 40}, {70, 900}};
  const auto damage_with = [&](double factor) {
    auto scaled = blocks;
    for (auto& block : scaled) block.amplitude_Pa *= factor;
    return miner_damage({100, 1e6, 5, factor * 300 > 100 ? std::optional(5.0) : std::nullopt}, scaled);
  };
  for (const auto second : {std::optional<double>(), std::optional(5.0)})
    for (const double repetitions : {1.0, 1e2, 1e4, 1e6, 1e12}) {
      const double factor = *life_factor({100, 1e6, 5, second, true}, blocks, repetitions, 0.5);
      EXPECT_LE(repetitions * damage_with(factor * (1 - 1e-12)), 0.5 * (1 + 1e-10)) << repetitions;
      EXPECT_GE(repetitions * damage_with(factor * (1 + 1e-12)), 0.5 * (1 - 1e-10)) << repetitions;
    }
  EXPECT_NEAR(*life_factor({100, 1e6, 5, 5.0, true}, {{101, 1}}, 1e9), 100.0 / 101, 1e-12);
}

}  // namespace
