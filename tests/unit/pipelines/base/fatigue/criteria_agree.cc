/// Rules of fatigue under proportional, reversed loading of a bar: where they must agree, exactly, and where
/// they differ by what their closed forms differ.
///
/// Bending sigma and torsion tau in one phase, R = -1, steel with tau_W = sigma_W / sqrt(3):
///   signed von Mises, FKM, Goodman, Gerber, Soderberg: sqrt(sigma^2 + 3 tau^2) / sigma_W, at any ratio;
///   Findley: s sigma / 2 + sqrt(sigma^2 / 4 + tau^2) over tau_W with s = 2 tau_W / sigma_W - 1, from Mohr's
///   circle of centre c and radius R: R sin 2u + k (c + R cos 2u) is at most k c + R sqrt(1 + k^2). It agrees
///   with von Mises in bending alone and in torsion alone and asks for up to sqrt(1 + 3 s^2), 3.5 %, between
///   them.
/// Turns red: a mean that proportional stress does not have, Findley's k from another ratio of strengths, the
/// amplitude of one instant instead of the range's half.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/fatigue/critical_plane.h"
#include "pipelines/base/fatigue/mean_stress.h"
#include "pipelines/judge/life/fatigue_rules.h"
#include "pipelines/superpose/between_instants/stress_course.h"

namespace {

using namespace pipelines;

constexpr double sigma_W_Pa = 270e6, rounding = 1e-12;
/// Planes are refined to 1e-7 rad, about a crest; the ends of the cycle are instants.
constexpr double of_the_plane = 1e-12;

FatigueScene steel() {
  FatigueScene scene;
  scene.material.tensile_strength_Pa = 600e6;
  scene.material.yield_strength_Pa = 355e6;
  scene.roughness_m = 1e-6;
  return scene;
}

/// sigma_zz and tau_yz of one cosine over 24 instants.
StressCourse proportional(double sigma_Pa, double tau_Pa) {
  Eigen::ArrayXXd values(1, 24);
  for (Eigen::Index i = 0; i < values.cols(); ++i)
    values(0, i) = std::cos(2 * M_PI * double(i) / double(values.cols()));
  UnitStresses unit = UnitStresses::Zero(6, 1);
  unit(2, 0) = sigma_Pa;
  unit(4, 0) = tau_Pa;
  return {unit, FactorCourse(values, Eigen::ArrayXd::Constant(1, 1e8), 48)};
}

double findley_closed_form(double sigma_Pa, double tau_Pa, double tau_W_Pa) {
  const double s = 2 * tau_W_Pa / sigma_W_Pa - 1;
  return (s * sigma_Pa / 2 + std::hypot(sigma_Pa / 2, tau_Pa)) / tau_W_Pa;
}

double findley_of(const StressCourse& course, double tau_W_Pa) {
  return findley(course.stress_Pa().matrix(), findley_limit(sigma_W_Pa, tau_W_Pa)).utilisation;
}

// Angle a from bending alone to torsion alone at the same von Mises stress, of either sign.
TEST(CriteriaAgree, InProportionalBendingAndTorsion) {
  const double of_mises_Pa = 180e6, tau_W_Pa = sigma_W_Pa / std::sqrt(3.0);
  double most = 0;
  for (int i = 0; i <= 24; ++i) {
    const double a = M_PI * i / 24, sigma_Pa = of_mises_Pa * std::cos(a),
                 tau_Pa = of_mises_Pa * std::sin(a) / std::sqrt(3.0);
    const auto course = proportional(sigma_Pa, tau_Pa);
    const auto cycle = course.largest().cycle;
    EXPECT_NEAR(cycle.amplitude_Pa, of_mises_Pa, rounding * of_mises_Pa) << i;
    EXPECT_NEAR(cycle.signed_mean_Pa, 0, rounding * of_mises_Pa) << i;

    // One cycle, whichever rule counts it.
    const auto scene = steel();
    const FatigueRules rules(scene);
    const auto limit = rules.limit(0, scalar(cycle));
    const auto blocks = rules.counted(course.cycles_along(direction_of(cycle.half_range_Pa)), limit);
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_NEAR(blocks[0].amplitude_Pa, of_mises_Pa / limit.reversed_Pa, rounding) << i;

    // Without mean the four lines and FKM are one.
    const double safety = sigma_W_Pa / of_mises_Pa;
    const auto by_line = mean_stress_safety(scalar(cycle), {sigma_W_Pa, 600e6, 355e6});
    for (const double other : {by_line.goodman, by_line.gerber, by_line.soderberg, by_line.asme_elliptic,
                               sigma_W_Pa / equivalent_reversed_amplitude_Pa(scalar(cycle), 0.11)})
      EXPECT_NEAR(other, safety, 1e-11 * safety) << i;
    EXPECT_NEAR(limit.amplitude_Pa, limit.reversed_Pa, rounding * limit.reversed_Pa) << i;

    // The critical plane by its own closed form; bending is reversed, so that its sign says nothing.
    const double plane = findley_of(course, tau_W_Pa);
    EXPECT_NEAR(plane, findley_closed_form(std::abs(sigma_Pa), tau_Pa, tau_W_Pa), of_the_plane) << i;
    EXPECT_GE(plane * safety, 1 - of_the_plane) << i;
    most = std::max(most, plane * safety);
    if (i % 12 == 0) {
      EXPECT_NEAR(plane * safety, 1, of_the_plane) << "bending alone, torsion alone";
    }
  }
  // cos a = x: sqrt(3) (s x / 2 + sqrt(1 / 3 - x^2 / 12)), which with x = 2 cos b is s sqrt(3) cos b + sin b.
  const double s = 2 / std::sqrt(3.0) - 1, largest = std::sqrt(1 + 3 * s * s);
  EXPECT_LE(most, largest + of_the_plane);
  EXPECT_GT(most, largest - 1e-3) << "angles of 7.5 degrees are 2 degrees from the largest";
}

// Pull and pressure in turn: all rules have one safety, sigma_W over the amplitude, whatever the ratio of the
// strengths in bending and torsion is; half the stress has twice of it.
TEST(CriteriaAgree, OnABarInReversedTension) {
  for (const double amplitude_Pa : {90e6, 180e6}) {
    const auto course = proportional(amplitude_Pa, 0);
    const auto cycle = course.largest().cycle;
    const double safety = sigma_W_Pa / amplitude_Pa;
    const auto by_line = mean_stress_safety(scalar(cycle), {sigma_W_Pa, 600e6, 355e6});
    for (const double other : {by_line.goodman, by_line.gerber, by_line.soderberg, by_line.asme_elliptic})
      EXPECT_NEAR(other, safety, rounding * safety);
    for (const double ratio : {0.577, 0.65, 0.8})
      EXPECT_NEAR(findley_of(course, ratio * sigma_W_Pa), 1 / safety, of_the_plane) << ratio;
  }
}

// Another steel: Findley follows its own ratio of strengths in torsion, von Mises cannot. tau_W / sigma_W =
// 0.65: torsion asks for 1 / 0.65 of bending, against sqrt(3).
TEST(CriteriaAgree, OnlyAsFarAsTheirStrengthsDo) {
  const double tau_W_Pa = 0.65 * sigma_W_Pa;
  for (const double ratio : {0.0, 0.2, 0.5, 1.0, 3.0}) {
    const auto course = proportional(100e6, 100e6 * ratio);
    EXPECT_NEAR(findley_of(course, tau_W_Pa), findley_closed_form(100e6, 100e6 * ratio, tau_W_Pa),
                of_the_plane)
        << ratio;
  }
  const auto torsion = proportional(0, 100e6);
  EXPECT_NEAR(torsion.largest().cycle.amplitude_Pa / sigma_W_Pa / findley_of(torsion, tau_W_Pa),
              0.65 * std::sqrt(3.0), of_the_plane);
}

}  // namespace
