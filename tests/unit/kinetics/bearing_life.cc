#include "kinetics/bearing_life.h"
#include "kinetics/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using Eigen::ArrayXd;
using kinetics::equivalent_load_N;
using kinetics::RollingElement;

constexpr auto ball = RollingElement::ball;
constexpr auto roller = RollingElement::roller;
using kinetics::pi;

// Closed forms; powers and their roots leave a few roundings.
constexpr double round_off = 1e-14;

}  // namespace

TEST(BearingLife, ConstantLoadIsItsOwnEquivalent) {
  for (const auto element : {ball, roller}) {
    EXPECT_NEAR(equivalent_load_N(ArrayXd::Constant(7, -1200), element) / 1200, 1, round_off);
    EXPECT_NEAR(equivalent_load_N(ArrayXd::Constant(7, 1e200), element) / 1e200, 1, round_off);
    EXPECT_EQ(equivalent_load_N(ArrayXd::Zero(7), element), 0);
  }
}

TEST(BearingLife, TwoLevels) {
  ArrayXd force_N(4);
  force_N << 1000, 3000, -1000, 1000;
  EXPECT_NEAR(equivalent_load_N(force_N, ball), std::cbrt((3 * 1e9 + 27e9) / 4), round_off * 3000);
  const double p = 10.0 / 3;
  EXPECT_NEAR(equivalent_load_N(force_N, roller), 1000 * std::pow((3 + std::pow(3, p)) / 4, 1 / p),
              round_off * 3000);
  ArrayXd levels(2), revolutions(2);
  levels << 1000, 3000;
  revolutions << 30, 10;
  EXPECT_NEAR(equivalent_load_N(levels, revolutions, ball), equivalent_load_N(force_N, ball),
              round_off * 3000);
}

// mean |sin|^3 over a turn is 4 / (3 pi). Equidistant instants: |sin|^3 has a kink in its third derivative
// twice a turn, so the sum errs by some n^-4.
TEST(BearingLife, SinusoidalLoad) {
  const ArrayXd angle = ArrayXd::LinSpaced(2000, 0, 2 * pi * 1999 / 2000);
  EXPECT_NEAR(equivalent_load_N(500 * angle.sin(), ball), 500 * std::cbrt(4 / (3 * pi)), 1e-8);
}

TEST(BearingLife, RatingLife) {
  // 1500 revolutions a minute, a tenth of the rating: 1000 million revolutions.
  const double speed_rad_s = 1500 * 2 * pi / 60;
  const auto balls = kinetics::rating_life(50e3, 5e3, ball, speed_rad_s);
  ASSERT_TRUE(balls);
  EXPECT_NEAR(balls->million_revolutions, 1000, 1e-11);
  EXPECT_NEAR(balls->hours, 1e9 / (1500 * 60), 1e-9);
  const auto rollers = kinetics::rating_life(50e3, 5e3, roller, speed_rad_s);
  EXPECT_NEAR(rollers->million_revolutions / std::pow(10, 10.0 / 3), 1, round_off);
  const auto at_rating = kinetics::rating_life(50e3, 50e3, roller, speed_rad_s);
  EXPECT_EQ(at_rating->million_revolutions, 1);
}

// No number stands for an unlimited life: the caller has to say what it means to him.
TEST(BearingLife, WithoutLoadThereIsNoLifeToState) {
  EXPECT_FALSE(kinetics::rating_life(50e3, 0, ball, 100));
  EXPECT_FALSE(kinetics::rating_life(50e3, 1e-300, ball, 100)) << "overflow";
  EXPECT_TRUE(kinetics::rating_life(50e3, 1e-6, ball, 100));
  EXPECT_EQ(kinetics::required_rating_N(0, 500, 0.9), 0);
  EXPECT_EQ(kinetics::reliability(0, 500, 20e3), 1);
}

TEST(BearingLife, ReliabilityAndRatingAreInverse) {
  const kinetics::WeibullLife rollers{0.05, 4.0, 1.3, 10.0 / 3};
  for (const auto& law : {kinetics::WeibullLife{}, rollers})
    for (const double R : {0.01, 0.5, 0.9, 0.99, 0.9999}) {
      const double rating_N = kinetics::required_rating_N(2000, 540, R, law);
      EXPECT_NEAR(kinetics::reliability(2000, 540, rating_N, law), R, 1e-12);
    }
  EXPECT_EQ(kinetics::reliability(1000, 540, kinetics::required_rating_N(1000, 540, 1) * 1.0001), 1);
  EXPECT_LT(kinetics::required_rating_N(1000, 540, 0.9), kinetics::required_rating_N(1000, 540, 0.95));
}

TEST(BearingLife, WrongInputIsRefused) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  ArrayXd with_nan = ArrayXd::Ones(3);
  with_nan[1] = bad;
  EXPECT_THROW(equivalent_load_N(with_nan, ball), std::invalid_argument);
  EXPECT_THROW(equivalent_load_N(ArrayXd(), ball), std::invalid_argument);
  EXPECT_THROW(equivalent_load_N(ArrayXd::Ones(3), ArrayXd::Ones(2), ball), std::invalid_argument);
  EXPECT_THROW(equivalent_load_N(ArrayXd::Ones(3), ArrayXd::Zero(3), ball), std::invalid_argument);
  EXPECT_THROW(equivalent_load_N(ArrayXd::Ones(3), -ArrayXd::Ones(3), ball), std::invalid_argument);
  EXPECT_THROW(kinetics::rating_life(0, 1, ball, 1), std::invalid_argument);
  EXPECT_THROW(kinetics::rating_life(1, -1, ball, 1), std::invalid_argument);
  EXPECT_THROW(kinetics::rating_life(1, 1, ball, 0), std::invalid_argument);
  EXPECT_THROW(kinetics::rating_life(1, bad, ball, 1), std::invalid_argument);
  EXPECT_THROW(kinetics::required_million_revolutions(-1, 1), std::invalid_argument);
  for (const double R : {0.0, -0.1, 1.1, bad})
    EXPECT_THROW(kinetics::required_rating_N(1, 1, R), std::invalid_argument);
  EXPECT_THROW(kinetics::required_rating_N(1, 1, 1, {0, 4.439, 1.483, 3}), std::invalid_argument);
  EXPECT_THROW(kinetics::required_rating_N(1, 1, 0.9, {0.02, 0, 1.483, 3}), std::invalid_argument);
  EXPECT_THROW(kinetics::reliability(1, 1, 0), std::invalid_argument);
}
