/// What DIN 743 is given of a shoulder: the gradient of the standard's table, and the program's own shape
/// factor. Turns red: phi on the wrong side of d/D = 0.67, a level that is not shared out by von Mises, a
/// mean along the changing part of the bending alone.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/judge/life/nominal_fatigue.h"

namespace {

using namespace pipelines;

// The shoulder of the published exercise (tests of din_743): D = 100, d = 84, r = 4 mm.
TEST(FilletsByDin743, GradientOfAShoulder) {
  const auto gradient = din_shoulder_gradient_1_m(0.084, 0.1, 0.004);
  EXPECT_NEAR(gradient.bending, 2.3 * (1 + 1 / (4 * std::sqrt(2.0) + 2)) / 4e-3, 1e-9);
  EXPECT_EQ(gradient.tension, gradient.bending);
  EXPECT_NEAR(gradient.torsion, 1.15 / 4e-3, 1e-9);
  EXPECT_NEAR(din_shoulder_gradient_1_m(0.06, 0.1, 0.004).bending, 2.3 / 4e-3, 1e-9) << "d/D = 0.6: no phi";
}

TEST(FilletsByDin743, TheLevelOfTheShapeFactorIsTheProgramsOwn) {
  const DinTriple published{1.9, 1.7, 1.3};
  const auto bending = own_shape_factor(published, {0, 50e6, 0}, 1.1 * 1.7 * 50e6);
  EXPECT_NEAR(bending.bending, 1.1 * 1.7, 1e-12);
  EXPECT_NEAR(bending.torsion, 1.1 * 1.3, 1e-12);
  // Bending and torsion together: the local von Mises amplitude comes out whatever the mix.
  const DinTriple nominal{5e6, 50e6, 40e6};
  const double local = 170e6;
  const auto mixed = own_shape_factor(published, nominal, local);
  EXPECT_NEAR(std::hypot(mixed.tension * nominal.tension + mixed.bending * nominal.bending,
                         std::sqrt(3.0) * mixed.torsion * nominal.torsion),
              local, 1e-6);
  const auto unknown = own_shape_factor(published, nominal, -1);
  EXPECT_EQ(unknown.bending, 1.7) << "without a local stress the published one";
  const auto soft = own_shape_factor(published, {0, 50e6, 0}, 10e6);
  EXPECT_EQ(soft.bending, 1) << "no notch strengthens";
}

/// A section of diameter 20 mm whose bending moments are those of the function, over a turn of 48 instants.
template <typename Moments>
DinLoad load_of_moments(const Moments& moments_Nm) {
  SectionResult section;
  section.plane.radius_m = 0.01;
  section.by_statics = SectionHistory::Zero(6, 48);
  for (int i = 0; i < 48; ++i) {
    const Eigen::Vector2d m = moments_Nm(2 * M_PI * i / 48);
    section.by_statics(3, i) = m.x();
    section.by_statics(4, i) = m.y();
  }
  return nominal_load(section);
}

constexpr double modulus_m3 = M_PI * 0.02 * 0.02 * 0.02 / 32;

// However little changes, and whichever way: static bending M counts whole. Of M cos(angle) along the part
// that changes nothing would be left at 90 degrees.
TEST(FilletsByDin743, StaticBendingAcrossWhatChangesCounts) {
  const double M = 50;
  for (const double small : {0.0, 1e-12, 1e-3, 5.0})
    for (const double angle : {0.0, 0.3, M_PI / 2, 2.0}) {
      const auto load = load_of_moments([&](double t) -> Eigen::Vector2d {
        return {M * std::cos(angle) + small * std::cos(t), M * std::sin(angle)};
      });
      EXPECT_NEAR(load.mean_Pa.bending, M / modulus_m3, 1e-12 * M / modulus_m3) << small << ' ' << angle;
      EXPECT_NEAR(load.amplitude_Pa.bending, small / modulus_m3, 1e-12 * M / modulus_m3);
    }
}

// Rotating bending has no mean, with a static part it has that; not less than along what changes most: of
// the corners (10, 10), (10, 0), (0, 10) the middles in x and y are 5, along the diagonal 15 / sqrt 2.
TEST(FilletsByDin743, MeanBendingIsNotLessThanAlongTheAmplitude) {
  const auto turning = load_of_moments([](double t) -> Eigen::Vector2d {
    return {30 * std::cos(t), 30 * std::sin(t)};
  });
  EXPECT_NEAR(turning.mean_Pa.bending, 0, 1e-3 * 30 / modulus_m3) << "48 instants and a degree: 2e-3 / 2";
  EXPECT_NEAR(turning.amplitude_Pa.bending, 30 / modulus_m3, 1e-12 * 30 / modulus_m3);
  const auto corners = load_of_moments([](double t) -> Eigen::Vector2d {
    if (t < 2) return {10, 10};
    return t < 4 ? Eigen::Vector2d{10, 0} : Eigen::Vector2d{0, 10};
  });
  EXPECT_NEAR(corners.mean_Pa.bending, 15 / std::sqrt(2.0) / modulus_m3, 1e-9 / modulus_m3);
}

}  // namespace
