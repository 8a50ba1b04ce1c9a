#include <gtest/gtest.h>

#include <cmath>

#include "fem/base/values/constants.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using fem::pi;

double volume_error(int n_sectors, int degree) {
  auto rod = fem_tests::rod(n_sectors);
  rod.body.degree = degree;
  const double exact = pi * 0.025 * 0.025 * 0.2;
  return 1 - fem::Model(rod.body).mass_properties().volume_m3 / exact;
}

// A parabola through three points of an arc misses its area by the fourth power of the sector's angle; a
// chord by the second.
TEST(MassProperties, VolumeErrorOfACylinderHasTheOrderOfTheGeometry) {
  const double coarse = volume_error(8, 2), fine = volume_error(16, 2);
  EXPECT_LT(std::abs(fine), 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2);
  EXPECT_NEAR(std::log2(volume_error(8, 1) / volume_error(16, 1)), 2, 0.1);
}

TEST(MassProperties, MomentsOfACylinder) {
  const fem::Model model(fem_tests::rod().body);
  const auto mass = model.mass_properties();
  const double m = 7850 * pi * 0.025 * 0.025 * 0.2;
  EXPECT_NEAR(mass.mass_kg, m, 1e-4 * m);
  EXPECT_NEAR(mass.first_moment_kg_m[0], 0, 1e-14);
  EXPECT_NEAR(mass.first_moment_kg_m[2], m * 0.1, 1e-4 * m * 0.1);
  EXPECT_NEAR(mass.second_moments_kg_m2[0], m * 0.025 * 0.025 / 4, 2e-4 * m * 0.025 * 0.025 / 4);
  EXPECT_NEAR(mass.second_moments_kg_m2[2], m * 0.04 / 3, 1e-4 * m * 0.04 / 3);
  for (int mixed = 3; mixed < 6; ++mixed) EXPECT_NEAR(mass.second_moments_kg_m2[mixed], 0, 1e-14);
}

// The seat is a cylinder of 25 mm by 40 mm about x = 2 mm; nothing else lies off the axis.
TEST(MassProperties, FirstMomentOfAnEccentricSeat) {
  const auto mass = fem::Model(fem_tests::eccentric_shaft().body).mass_properties();
  const double exact = 7850 * pi * 0.025 * 0.025 * 0.04 * 0.002;
  EXPECT_NEAR(mass.first_moment_kg_m[0], exact, 2e-3 * exact);  // eight sectors
  EXPECT_NEAR(mass.first_moment_kg_m[1], 0, 1e-12 * exact);
}

TEST(MassProperties, NodalVolumesSumToTheVolume) {
  const auto shaft = fem_tests::eccentric_shaft(2);
  const fem::Model model(shaft.body);
  const auto responses =
      model.unit_responses({fem_tests::resultant(shaft, "seat", fem::SurfaceResultant::Component::fx)}, {});
  double sum = 0;
  for (const double v : responses.nodes.volume_m3) sum += v;
  EXPECT_NEAR(sum, model.mass_properties().volume_m3, 1e-12 * sum);
}

}  // namespace
