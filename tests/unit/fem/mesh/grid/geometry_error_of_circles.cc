#include <gtest/gtest.h>

#include <cmath>

#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

double error(int degree, int n_sectors) {
  auto rod = fem_tests::rod(n_sectors);
  rod.body.degree = degree;
  const auto result = fem::Model(rod.body).geometry_error();
  EXPECT_GT(result.n_faces, 0u);
  return result.relative;
}

// A chord of the angle 2 a misses its circle by 1 - cos a in the middle; Gauss points do not lie in the
// middle, so a little less is seen (four points: 0.34 of the half width from it; three of Q1: the middle
// itself).
TEST(GeometryError, OfChordsIsTheirSagitta) {
  for (const int n : {8, 16})
    EXPECT_NEAR(error(1, n), 1 - std::cos(M_PI / n), 0.02 * (1 - std::cos(M_PI / n)));
}

// A parabola through three points of a circle misses it by O(a^4): 16 times less with twice the sectors; a
// mapping that is straight, or nodes beside the circle, would show.
TEST(GeometryError, OfParabolasFallsWithTheFourthPower) {
  const double coarse = error(2, 8), fine = error(2, 16);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 16, 2);
}

// The rod's outside and its two ends' rims have one surface each at most; the flat ends none.
TEST(GeometryError, IsToldSurfaceBySurface) {
  auto rod = fem_tests::rod(8);
  const auto result = fem::Model(rod.body).geometry_error();
  ASSERT_EQ(result.surfaces.size(), 1u);
  EXPECT_EQ(result.surfaces.begin()->first, rod.ports.at("rod").boundary_id);
  EXPECT_EQ(result.surfaces.begin()->second.of_axis, result.relative);
  EXPECT_EQ(result.surfaces.begin()->second.of_fillet, 0);
}

TEST(GeometryError, SeesTheSeatsThatItIsGiven) {
  auto rod = fem_tests::rod(16);
  auto seat = rod.ports.at("rod");
  seat.radius_m *= 1.01;
  EXPECT_NEAR(fem::Model(rod.body).geometry_error({seat}).relative, 0.01, 1e-3);
}

}  // namespace
