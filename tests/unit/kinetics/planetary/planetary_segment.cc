// The charge's segment from nearly empty to nearly full, against bisection in extended precision.
#include "kinetics/planetary_effects/segment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using kinetics::planetary::Segment;

const long double pi_l = acosl(-1.0L);
constexpr long double pi_l_excess = 5.0165576126683320e-20L;  // by which pi_l exceeds pi

/// pi - angle
long double to_pi_l(double angle) {
  return (pi_l - (long double)angle) - pi_l_excess;
}

/// x - sin x to 1e-19: the power series below 2 (40 terms), directly above.
long double x_minus_sin_l(long double x) {
  if (x > 2) return x - sinl(x);
  long double term = x * x * x / 6, sum = 0;
  for (int k = 2; k < 40; ++k) {
    sum += term;
    term *= -x * x / ((2 * k) * (2 * k + 1.0L));
  }
  return sum;
}

/// Half angle of the segment that takes this share of the circle, by bisection.
long double half_angle_l(long double share) {
  long double low = 0, high = pi_l;
  if (share < 0.01L) high = 2 * cbrtl(12 * pi_l * share);
  for (int i = 0; i < 200; ++i) {
    const long double middle = (low + high) / 2;
    (x_minus_sin_l(middle) < 2 * pi_l * share ? low : high) = middle;
  }
  return (low + high) / 4;
}

double relative(double ours, long double reference) {
  return double(std::abs((long double)ours / reference - 1));
}

// The worst that these tests measured is 3.4e-16 (angles), 6e-16 (centroid): one to three roundings.
constexpr double angle_tolerance = 5e-16, centroid_tolerance = 1.5e-15;

long double centroid_l(long double smaller_half_angle, bool nearly_empty) {
  const long double sine = sinl(smaller_half_angle);
  const long double share = x_minus_sin_l(2 * smaller_half_angle) / (2 * pi_l);
  return 2 * sine * sine * sine / (3 * pi_l * (nearly_empty ? share : 1 - share));
}

}  // namespace

TEST(PlanetarySegment, FillingAndVoidGiveAngleAndCentroid) {
  for (const double share :
       {1e-300, 1e-200, 1e-100, 1e-40, 1e-20, 1e-12, 1e-9,  3e-8, 1e-6, 1e-4, 1e-3,     0.01,
        0.05,   0.1,    0.1957, 0.2,   0.25,  0.3,   0.333, 0.4,  0.45, 0.49, 0.499999, 0.5}) {
    SCOPED_TRACE(share);
    const long double half = half_angle_l(share);
    const Segment empty = kinetics::planetary::segment_of_filling(share);
    EXPECT_LE(relative(empty.half_angle_rad, half), angle_tolerance);
    EXPECT_LE(relative(empty.sine, sinl(half)), angle_tolerance);
    EXPECT_LE(relative(centroid_distance(empty), centroid_l(half, true)), centroid_tolerance);
    const Segment full = kinetics::planetary::segment_of_void(share);
    EXPECT_LE(relative(full.opening_rad, half), angle_tolerance);
    EXPECT_LE(relative(full.half_angle_rad, pi_l - half), angle_tolerance);
    EXPECT_LE(relative(full.sine, sinl(half)), angle_tolerance);
    EXPECT_LE(relative(centroid_distance(full), centroid_l(half, false)), centroid_tolerance);
  }
}

// 1 - f is exact for f >= 1/2, so a filling near one says as much as its void.
TEST(PlanetarySegment, FillingNearOneIsItsVoid) {
  for (const double filling : {1 - 1e-15, 1 - 1e-12, 1 - 1e-6, 0.999, 0.9, 0.75, 0.51}) {
    const Segment a = kinetics::planetary::segment_of_filling(filling);
    const Segment b = kinetics::planetary::segment_of_void(1 - filling);
    EXPECT_EQ(a.opening_rad, b.opening_rad) << filling;
    EXPECT_EQ(a.sine, b.sine) << filling;
    EXPECT_EQ(a.filling, filling);
  }
}

// The opening of a half angle near pi needs more digits of pi than a double has.
TEST(PlanetarySegment, HalfAngleGivesTheFilling) {
  for (const double gamma : {1e-100, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 0.7499, 0.7501, 1.0, 1.5, 1.5707963, 1.58,
                             2.0, 2.5, 3.0, 3.14, 3.14159, 3.1415926}) {
    SCOPED_TRACE(gamma);
    const bool lower = gamma < 1.57;
    const long double smaller = lower ? (long double)gamma : to_pi_l(gamma);
    const long double share = x_minus_sin_l(2 * smaller) / (2 * pi_l);
    const Segment ours = kinetics::planetary::segment_of_half_angle(gamma);
    EXPECT_LE(relative(ours.filling, lower ? share : 1 - share), 1e-15);
    EXPECT_LE(relative(ours.sine, sinl(smaller)), angle_tolerance);
    EXPECT_LE(relative(ours.opening_rad, to_pi_l(gamma)), angle_tolerance);
    EXPECT_LE(relative(centroid_distance(ours), centroid_l(smaller, lower)), centroid_tolerance);
    if (gamma > 1e-90 && gamma < 2.6) {  // there and back; nearer to pi a filling cannot say the angle
      EXPECT_NEAR(kinetics::planetary::segment_of_filling(ours.filling).half_angle_rad / gamma, 1, 4e-15);
    }
  }
}

TEST(PlanetarySegment, Limits) {
  const Segment empty = kinetics::planetary::segment_of_filling(0);
  EXPECT_EQ(empty.half_angle_rad, 0);
  EXPECT_EQ(empty.sine, 0);
  EXPECT_EQ(centroid_distance(empty), 1);
  const Segment trace = kinetics::planetary::segment_of_half_angle(1e-120);  // its area underflows
  EXPECT_EQ(trace.filling, 0);
  EXPECT_EQ(centroid_distance(trace), 1);
  const Segment full = kinetics::planetary::segment_of_filling(1);
  EXPECT_EQ(full.filling, 1);
  EXPECT_EQ(full.sine, 0);
  EXPECT_EQ(centroid_distance(full), 0);
  EXPECT_EQ(kinetics::planetary::segment_of_half_angle(machines::pi).filling, 1);
  const Segment half = kinetics::planetary::segment_of_filling(0.5);
  EXPECT_NEAR(half.half_angle_rad, machines::pi / 2, 2e-16);
  EXPECT_NEAR(centroid_distance(half), 4 / (3 * machines::pi), 1e-16);
}

// Charge and void together are the drum: their first moments cancel, their masses add up.
TEST(PlanetarySegment, ChargeAndVoidMakeUpTheDrum) {
  auto mill = machines::printed_planetary();
  mill.charge.half_angle_rad.reset();
  const double full_kg = 4600 * machines::pi * 0.01;
  for (const double share : {1e-250, 1e-30, 1e-15, 1e-8, 0.1, 0.37, 0.5}) {
    mill.charge.filling = share, mill.charge.void_fraction.reset();
    const auto charge = planetary_charge_body(mill);
    mill.charge.filling.reset(), mill.charge.void_fraction = share;
    const auto rest = planetary_charge_body(mill);
    EXPECT_EQ(charge.first_moment_kg_m, rest.first_moment_kg_m);
    EXPECT_GT(charge.first_moment_kg_m, 0);
    EXPECT_NEAR((charge.mass_kg + rest.mass_kg) / full_kg, 1, 1e-15);
    EXPECT_NEAR(charge.mass_kg * charge.centroid_m / charge.first_moment_kg_m, 1, 2e-15);
    EXPECT_NEAR(rest.mass_kg * rest.centroid_m / rest.first_moment_kg_m, 1, 2e-15);
  }
}
