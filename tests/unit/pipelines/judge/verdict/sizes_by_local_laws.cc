/// Radius and thickness that bring a stress down, beside the closed forms that they follow. Turns red: a
/// factor that is taken the wrong way round, bending that goes by the thickness, own mass that is left out, a
/// kind of load with the notch factor of another, a size that is rounded to where it does not do.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/models/beam/fillet_factors.h"
#include "pipelines/judge/verdict/local_laws.h"

namespace {

using namespace pipelines;

constexpr ShoulderSize shoulder{0.04, 0.06, 0.001};
/// Sizes are found to a four-thousandth of a thousandth of the whole range.
constexpr double found_m = 0.01 / 400 / 1000;

double k_bending(double radius_m) {
  return fem::fillet_factors(shoulder.small_m, shoulder.large_m, radius_m).bending;
}
double k_torsion(double radius_m) {
  return fem::fillet_factors(shoulder.small_m, shoulder.large_m, radius_m).torsion;
}

// The nominal stress cancels: the radius is where the factor is that of before over 1.2.
TEST(SizesByLocalLaws, ARadiusFollowsTheNotchFactor) {
  const auto bent = radius_for(shoulder, {0, 80e6, 0}, 1.2);
  ASSERT_TRUE(bent);
  EXPECT_LE(k_bending(*bent), k_bending(0.001) / 1.2);
  EXPECT_GT(k_bending(*bent - 2 * found_m), k_bending(0.001) / 1.2) << "the least one";
  EXPECT_NEAR(*bent, *radius_for(shoulder, {0, 1, 0}, 1.2), 1e-12) << "whatever the size of the load";
  const auto turned = radius_for(shoulder, {0, 0, 80e6}, 1.2);
  ASSERT_TRUE(turned);
  EXPECT_LE(k_torsion(*turned), k_torsion(0.001) / 1.2);
  EXPECT_GT(k_torsion(*turned - 2 * found_m), k_torsion(0.001) / 1.2);
  const auto both = radius_for(shoulder, {0, 80e6, 60e6}, 1.2);
  ASSERT_TRUE(both);
  EXPECT_NEAR(std::hypot(80 * k_bending(*both), std::sqrt(3.0) * 60 * k_torsion(*both)) * 1.2,
              std::hypot(80 * k_bending(0.001), std::sqrt(3.0) * 60 * k_torsion(0.001)), 0.02);
}

TEST(SizesByLocalLaws, NoRadiusBeyondTheShoulder) {
  const double most = k_bending(0.001) / k_bending(0.00999);
  EXPECT_TRUE(radius_for(shoulder, {0, 1, 0}, 0.99 * most));
  EXPECT_FALSE(radius_for(shoulder, {0, 1, 0}, 1.01 * most));
  EXPECT_FALSE(radius_for(shoulder, {0, 0, 0}, 1.2)) << "a stress that has another cause";
  EXPECT_FALSE(radius_for({0.04, 0.042, 0.0012}, {0, 1, 0}, 1.01)) << "as large as the step already";
}

// What supports a sharp notch is missing in a wide one.
TEST(SizesByLocalLaws, ARadiusLosesSupport) {
  const auto strength = [](double radius_m) { return std::pow(radius_m, -0.1); };
  const auto radius_m = radius_for(shoulder, {0, 1, 0}, 1.2, strength);
  ASSERT_TRUE(radius_m);
  EXPECT_NEAR(k_bending(*radius_m) * std::pow(*radius_m / 0.001, 0.1) * 1.2, k_bending(0.001), 1e-3);
}

PlateStress plate(double membrane, double bending) {
  return {Stress{membrane}, Stress{bending}};
}

TEST(SizesByLocalLaws, BendingGoesByTheSquareOfTheThickness) {
  const double rounding = 1e-5;
  EXPECT_NEAR(*thickness_for(plate(0, 50e6), 0.006, 0, 1.44), 0.006 * 1.2, rounding * 0.006);
  EXPECT_NEAR(*thickness_for(plate(50e6, 0), 0.006, 0, 1.44), 0.006 * 1.44, rounding * 0.006);
  // m / x + b / x^2 = (m + b) / f: x = f (m + sqrt(m^2 + 4 b (m + b) / f)) / (2 (m + b))
  const double m = 20, b = 30, f = 1.5;
  EXPECT_NEAR(*thickness_for(plate(m, b), 1, 0, f),
              f * (m + std::sqrt(m * m + 4 * b * (m + b) / f)) / (2 * (m + b)), rounding);
  EXPECT_NEAR(*thickness_for(plate(-20, 70), 1, 0, 1.44), 1.2, rounding) << "no faster than bending";
  // Where bending relieves the face, 100 / x - 80 / x^2 rises with the thickness.
  EXPECT_FALSE(thickness_for(plate(100, -80), 1, 0, 1.01));
  EXPECT_FALSE(thickness_for(plate(0, 1), 0.006, 0, 4.2)) << "beyond twice the thickness";
}

// A wall that carries its own mass: bending falls by the thickness alone, membrane stress not at all.
TEST(SizesByLocalLaws, OwnMassGrowsWithTheThickness) {
  EXPECT_NEAR(*thickness_for(plate(0, 1), 1, 1, 1.3), 1.3, 1e-5);
  EXPECT_FALSE(thickness_for(plate(1, 0), 1, 1, 1.01));
  EXPECT_NEAR(*thickness_for(plate(1, 0), 1, 0.25, 1.25), 0.75 / (1 / 1.25 - 0.25), 1e-5);
}

// IIW's factor of thick plates: x^2 = f x^0.3.
TEST(SizesByLocalLaws, AThickWeldIsWeaker) {
  const auto strength = [](double thickness_m) { return std::pow(0.025 / thickness_m, 0.3); };
  EXPECT_NEAR(*thickness_for(plate(0, 1), 0.03, 0, 1.4, strength), 0.03 * std::pow(1.4, 1 / 1.7), 1e-6);
}

TEST(SizesByLocalLaws, BothFacesTellThePartsOfTheStress) {
  const auto parts = plate_stress({80, 10, 0, 4, 0, 0}, {20, 30, 0, -4, 0, 0});
  EXPECT_EQ(parts.membrane, (Stress{50, 20, 0, 0, 0, 0}));
  EXPECT_EQ(parts.bending, (Stress{30, -10, 0, 4, 0, 0}));
}

TEST(SizesByLocalLaws, SizesHaveTwoDigits) {
  EXPECT_NEAR(two_digits_up_m(0.00441), 0.0045, 1e-15);
  EXPECT_NEAR(two_digits_up_m(0.0045), 0.0045, 1e-15);
  EXPECT_NEAR(two_digits_up_m(0.01201), 0.013, 1e-15);
  EXPECT_NEAR(two_digits_down_m(0.01299), 0.012, 1e-15);
}

}  // namespace
