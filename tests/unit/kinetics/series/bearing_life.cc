#include "kinetics/series/bearing_life.h"
#include "kinetics/values/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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

// ISO 281:2007, Table 12, printed in two digits: half of the last one.
TEST(BearingLife, FactorOfReliabilityIsThatOfTheTable) {
  const std::vector<std::pair<double, double>> table = {
      {0.90, 1},      {0.95, 0.64},    {0.96, 0.55},   {0.97, 0.47},   {0.98, 0.37},
      {0.99, 0.25},   {0.992, 0.22},   {0.994, 0.19},  {0.996, 0.16},  {0.998, 0.12},
      {0.999, 0.093}, {0.9992, 0.087}, {0.9994, 0.08}, {0.9995, 0.077}};
  for (const auto& [share, a1] : table)
    EXPECT_NEAR(kinetics::life_factor(share), a1, share < 0.999 ? 0.005 : 0.0005) << share;
  for (const double beyond : {0.5, 0.8999, 0.99951, 1.0, std::nan("")})
    EXPECT_THROW(kinetics::life_factor(beyond), std::invalid_argument) << beyond;
}

// The curves of ISO 281:2007 are given in three pieces that meet at kappa = 0.4 and 1: a wrong digit in one
// of their constants would leave a step. Their constants have five digits, the powers nine: 1e-2 of the
// factor.
TEST(BearingLife, ModificationFactorHasNoSteps) {
  for (const auto element : {ball, roller})
    for (const double kappa : {0.4, 1.0})
      for (const double load_N : {3e3, 1e4, 1e5}) {
        const double below =
            kinetics::life_modification_factor({kappa * (1 - 1e-9), 0.5, 1000}, load_N, element);
        const double above = kinetics::life_modification_factor({kappa, 0.5, 1000}, load_N, element);
        EXPECT_NEAR(above / below, 1, 1e-2) << kappa << ' ' << load_N;
      }
}

// At kappa = 1 the powers of kappa are 1: 2.5671 - 1.9987 = 0.5684 and 1.5859 - 1.2348 = 0.3511 by hand.
TEST(BearingLife, ModificationFactorAtFullFilm) {
  EXPECT_NEAR(kinetics::life_modification_factor({1, 0.5, 1000}, 4000, ball),
              0.1 * std::pow(1 - std::pow(0.5684, 0.83) * 0.5, -9.3), 1e-12);
  EXPECT_NEAR(kinetics::life_modification_factor({1, 1, 1000}, 1000 * std::pow(2, 2.5), roller),
              0.1 * std::pow(1 - 0.3511 * 0.5, -9.185), 1e-12);
  // In dirt, or under loads far above the limit, nine tenths of the life are lost; ISO 281 caps at 50 and 4.
  EXPECT_NEAR(kinetics::life_modification_factor({1, 1e-12, 1000}, 1e9, ball), 0.1, 1e-6);
  EXPECT_EQ(kinetics::life_modification_factor({4, 1, 1000}, 100, ball), 50);
  EXPECT_EQ(kinetics::life_modification_factor({4, 0.3, 1000}, 3000, roller),
            kinetics::life_modification_factor({9, 0.3, 1000}, 3000, roller));
  for (const auto& bad : {kinetics::Lubrication{0.09, 0.5, 1e3}, kinetics::Lubrication{1, 0, 1e3},
                          kinetics::Lubrication{1, 1.1, 1e3}, kinetics::Lubrication{1, 0.5, 0}})
    EXPECT_THROW(kinetics::life_modification_factor(bad, 1e3, ball), std::invalid_argument);
  EXPECT_THROW(kinetics::life_modification_factor({1, 0.5, 1e3}, 0, ball), std::invalid_argument);
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
