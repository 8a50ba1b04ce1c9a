// Rotating thin discs: P05 of the public cases. The solid disc is a free body, the annular one a quarter.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/cylinder_quarter.h"
#include "tests/verification/fem/bodies/field_errors.h"

namespace {

constexpr double a = 0.05, b = 0.2, thickness = 0.01, omega_rad_s = 1000;
constexpr fem::Material steel{210e9, 0.3, 7800};
const verification::LoadCase spin = {{fem::BodyForce{fem::BodyForce::Field::spin}, omega_rad_s* omega_rad_s}};

TEST(P05, SolidDisc) {
  meshes::Shaft disc;
  disc.segments = {{"disc", 0, thickness, 2 * b, 0, false}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 12;
  auto body = fem_tests::build(disc, control).body;
  body.material = steel;
  const auto s = verification::solve(body, spin);
  // On the middle plane: the plane stress solution is that of the mean over the thickness.
  const auto centre = s.at({0, 0, thickness / 2}), rim = s.at({b, 0, thickness / 2});
  verification::check({"P05", "solid: sigma at the centre [Pa]", 128.7e6, s.stress_Pa(0, centre)}, s, 0.01);
  verification::check({"P05", "solid: sigma_theta(b) [Pa]", 54.6e6, s.stress_Pa(1, rim)}, s, 0.02);
  verification::check({"P05", "solid: u_r(b) [m]", 5.2e-5, s.displacement_m(0, rim)}, s, 0.005);
}

fem::Body annulus(int degree, double height_m, int n_radial, int n_around, int n_along) {
  auto body = verification::cylinder_quarter({a, b, height_m, n_radial, n_around, n_along});
  body.degree = degree;
  body.material = steel;
  return body;
}

TEST(P05, AnnularDisc) {
  const auto s =
      verification::solve(annulus(2, thickness / 2, 8, 4, 2), spin);  // half, above its middle plane
  const auto inner = s.at({a, 0, 0}), outer = s.at({b, 0, 0}), middle = s.at({0.1, 0, 0});
  verification::check({"P05", "annular: sigma_theta(a) [Pa]", 260.8125e6, s.stress_Pa(1, inner)}, s, 0.01);
  verification::check({"P05", "annular: sigma_theta(b) [Pa]", 70.6875e6, s.stress_Pa(1, outer)}, s, 0.02);
  verification::check({"P05", "annular: largest sigma_r [Pa]", 72.39375e6, s.stress_Pa(0, middle)}, s, 0.01);
  verification::check({"P05", "annular: u_r(a) [m]", 6.209821429e-5, s.displacement_m(0, inner)}, s, 0.005);
}

/// The disc's solution with E / (1 - nu^2) and nu / (1 - nu) for E and nu is that of a long cylinder whose
/// ends stay where they are, exact in three dimensions. Source: Timoshenko and Goodier, art. 32.
verification::Field long_cylinder() {
  const double nu_3 = steel.poisson_ratio, nu = nu_3 / (1 - nu_3);
  const double e = steel.youngs_modulus_Pa / (1 - nu_3 * nu_3);
  const double w = steel.density_kg_m3 * omega_rad_s * omega_rad_s / 8;
  const auto stress = [=](double r) {
    const double radial = w * (3 + nu) * (a * a + b * b - a * a * b * b / (r * r) - r * r);
    const double around = w * ((3 + nu) * (a * a + b * b + a * a * b * b / (r * r)) - (1 + 3 * nu) * r * r);
    return std::array<double, 3>{radial, around, nu_3 * (radial + around)};
  };
  return verification::axisymmetric(
      [=](double r) {
        const auto s = stress(r);
        return r / e * (s[1] - nu * s[0]);
      },
      stress);
}

class P05Orders : public testing::TestWithParam<int> {};
TEST_P(P05Orders, DisplacementPPlus1AndStressP) {
  const int degree = GetParam();
  const auto held = [&](int cells) {
    auto body = annulus(degree, 0.02, cells, cells / 2, 1);
    body.clamps.push_back({verification::end_3, {false, false, true}});
    return body;
  };
  verification::expect_orders("P05", long_cylinder(), held(8), held(16), spin);
}
INSTANTIATE_TEST_SUITE_P(Q, P05Orders, testing::Values(1, 2, 3));

}  // namespace
