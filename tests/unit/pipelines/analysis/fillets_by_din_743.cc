/// What DIN 743 is given of a shoulder: the gradient of the standard's table, and the program's own shape
/// factor. Turns red: phi on the wrong side of d/D = 0.67, a level that is not shared out by von Mises.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/analysis/nominal_fatigue.h"

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

}  // namespace
