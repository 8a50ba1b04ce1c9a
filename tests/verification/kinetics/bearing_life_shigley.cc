// Shigley's Mechanical Engineering Design, problem 11-1 and example 11-1 (public case P24).
#include <gtest/gtest.h>

#include <cmath>

#include "kinetics/series/bearing_life.h"

namespace {

double rad_s(double per_minute) {
  return per_minute * 2 * std::acos(-1.0) / 60;
}

void expect_relative(double value, double reference, double tolerance) {
  EXPECT_NEAR(value / reference, 1, tolerance);
}

}  // namespace

// A deep-groove ball bearing for 30 000 h at 300 rev/min, 1.898 kN with application factor 1.2.
TEST(BearingLifeShigley, Problem111) {
  const double x_D = kinetics::required_million_revolutions(30000, rad_s(300));
  expect_relative(x_D, 540, 1e-9);
  const double load_N = 1898 * 1.2;
  const double rating_N = kinetics::required_rating_N(load_N, x_D, 0.90);
  expect_relative(rating_N, 18588.38007, 1e-9);  // printed 18.59 kN; the closed form to its ten digits
  const double R = kinetics::reliability(load_N, x_D, 19.5e3);
  expect_relative(R, 0.9187450865, 1e-9);  // printed 0.919
}

// 400 lbf for 5000 h at 1725 rev/min by the catalogue's rating alone. The formula is free of the load's unit.
TEST(BearingLifeShigley, Example111) {
  const double x_D = kinetics::required_million_revolutions(5000, rad_s(1725));
  const double rating_lbf = 400 * std::pow(x_D, 1 / kinetics::life_exponent(kinetics::RollingElement::ball));
  expect_relative(rating_lbf, 3211.417547, 1e-9);
  const auto life = kinetics::rating_life(3211.417547, 400, kinetics::RollingElement::ball, rad_s(1725));
  ASSERT_TRUE(life);
  expect_relative(life->hours, 5000, 1e-9);
}
