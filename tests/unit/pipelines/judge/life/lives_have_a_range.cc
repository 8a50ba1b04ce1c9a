// What an error of the stress makes of a life, and where S-N curves end.
// Turns red: the error on the wrong side, a range where nothing is known, a border at another number of
// cycles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipelines/judge/life/life_certainty.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/write/parts/fatigue_report.h"

using namespace pipelines;

namespace {

const SnCurve falling{100e6, 1e6, 5, {}};  // endures 100 MPa

LifeCertainty certainty(double amplitude_Pa, double error, const std::string& beyond = "") {
  return certainty_of(error, beyond,
                      [&](double factor) { return cycles_to_failure(falling, factor * amplitude_Pa); });
}

}  // namespace

// N = 1e6 (100 / 200)^5 at 200 MPa; rounding alone.
TEST(LifeCertainty, FollowsThePowerOfTheStress) {
  const auto range = certainty(200e6, 0.1).range;
  ASSERT_TRUE(range);
  EXPECT_NEAR(*range->least_s, 1e6 / std::pow(2.2, 5), 1e-6);
  EXPECT_NEAR(*range->most_s, 1e6 / std::pow(1.8, 5), 1e-6);
}

TEST(LifeCertainty, MayEndAboveOrBelowTheLimit) {
  const auto endures = certainty(95e6, 0.1).range, fails = certainty(105e6, 0.1).range;
  ASSERT_TRUE(endures && fails);
  EXPECT_NEAR(*endures->least_s, 1e6 / std::pow(1.045, 5), 1e-5);
  EXPECT_FALSE(endures->most_s);
  EXPECT_FALSE(fails->most_s);
  EXPECT_TRUE(fails->least_s);
}

TEST(LifeCertainty, IsNoneWhereTheStressOrTheCurveIsNotKnown) {
  EXPECT_FALSE(certainty(200e6, 1).range);
  EXPECT_FALSE(certainty(200e6, std::numeric_limits<double>::infinity()).range);
  const auto beyond = certainty(200e6, 0.1, "why");
  EXPECT_FALSE(beyond.range);
  EXPECT_EQ(beyond.beyond, "why");
}

// An amplitude that the instants all but miss seemed to endure, without a word.
TEST(LifeCertainty, WhatSeemsToEndureHasALeastLifeWhateverTheError) {
  const auto missed = certainty(60e6, 3).range, small = certainty(20e6, 3).range;
  ASSERT_TRUE(missed && small);
  EXPECT_NEAR(*missed->least_s, 1e6 / std::pow(2.4, 5), 1e-6);
  EXPECT_FALSE(missed->most_s);
  EXPECT_FALSE(small->least_s) << "endures all the same";
  EXPECT_FALSE(certainty(60e6, std::numeric_limits<double>::infinity()).range);
}

// A place that nothing changes endures, whether its stress is known or not.
TEST(LifeCertainty, WithoutAnAmplitudeNoErrorMatters) {
  const auto range = certainty(0, std::numeric_limits<double>::infinity()).range;
  ASSERT_TRUE(range);
  EXPECT_FALSE(range->least_s || range->most_s);
  EXPECT_TRUE(certainty(0, 3).range);
}

TEST(LifeCertainty, SafetiesAreLessByTheError) {
  EXPECT_NEAR(*least_safety(1.2, 0.25), 0.96, 1e-12);
  EXPECT_FALSE(least_safety(1.2, std::numeric_limits<double>::infinity()));
}

// "endures" stands alone only where the error leaves no life.
TEST(LifeCertainty, HasWords) {
  const auto text = [](double amplitude_Pa, double error, const std::string& beyond = "") {
    return life_text(cycles_to_failure(falling, amplitude_Pa), certainty(amplitude_Pa, error, beyond));
  };
  constexpr double unknown = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text(80e6, 0.1), "endures");
  EXPECT_EQ(text(95e6, 0.1), "endures; 220 h with the stated error") << "1e6 / 1.045^5 s";
  EXPECT_EQ(text(95e6, unknown), "endures, its error not known");
  EXPECT_EQ(text(0, unknown), "endures");
  EXPECT_EQ(text(105e6, 0.1), "220 h (140 to ever)");
  EXPECT_EQ(text(105e6, unknown), "220 h, not known well");
}

// 1e4 cycles are endured at 100 MPa (1e6 / 1e4)^(1/5) = 251.19 MPa.
TEST(LifeCertainty, CurvesEndAtYieldAndAtTenThousandCycles) {
  const double most = 100e6 * std::pow(100, 0.2);
  const auto text = [&](double largest_Pa, double amplitude_Pa) {
    return beyond_curve(largest_Pa, 300e6, falling, {{90e6, 1}, {amplitude_Pa, 1}, {400e6, 0}});
  };
  EXPECT_EQ(text(300e6, 0.999 * most), "");
  EXPECT_NE(text(300.1e6, 0.999 * most).find("exceed the yield strength, 300 MPa"), std::string::npos);
  EXPECT_NE(text(300e6, 1.001 * most).find("S-N curves begin at 1e+04"), std::string::npos);
  EXPECT_EQ(text(100e6, 80e6), "") << "endures";
}

// Wanted twice: a factor of 251.19 / 50 would bring 1e4 cycles, one of 100 (5e5)^(1/5) / 50 two of them.
TEST(LifeCertainty, NoSafetyIsBeyondTheCurve) {
  const std::vector<StressBlock> blocks{{50e6, 1}, {400e6, 0}};
  const double most = 2 * std::pow(100, 0.2);
  EXPECT_NEAR(*life_safety(falling, blocks, 2), most, 1e-12);
  EXPECT_NEAR(*life_safety(falling, blocks, 1e4), most, 1e-12);
  EXPECT_NEAR(*life_safety(falling, blocks, 3e4, 0.5), 2 * std::pow(1e6 / 6e4, 0.2), 1e-12);
  EXPECT_FALSE(life_safety(falling, {{0, 1}}, 2));
}
