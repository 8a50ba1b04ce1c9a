// Lame's thick cylinder under internal pressure, plane strain: P04 of the public cases. A quarter between
// symmetry planes, its ends held along z.
#include <gtest/gtest.h>

#include "tests/verification/fem/bodies/cylinder_quarter.h"
#include "tests/verification/fem/bodies/field_errors.h"

namespace {

using verification::Point;

constexpr double a = 0.1, b = 0.2, height = 0.02, p_Pa = 50e6;
constexpr fem::Material steel{210e9, 0.3, 7850};

fem::Body body(int degree, int n_radial, int n_around) {
  auto quarter = verification::cylinder_quarter({a, b, height, n_radial, n_around, 1});
  quarter.degree = degree;
  quarter.material = steel;
  quarter.clamps.push_back({verification::end_3, {false, false, true}});
  return quarter;
}

verification::LoadCase inside() {
  return {{verification::uniform_pressure(verification::begin_1, {0, 0, height / 2}, height), p_Pa}};
}

/// Source: Timoshenko and Goodier, Theory of Elasticity, art. 28.
verification::Field exact() {
  const double e = steel.youngs_modulus_Pa, nu = steel.poisson_ratio, s = p_Pa * a * a / (b * b - a * a);
  return verification::axisymmetric(
      [=](double r) { return (1 + nu) / e * s * ((1 - 2 * nu) * r + b * b / r); },
      [=](double r) {
        return std::array<double, 3>{s * (1 - b * b / (r * r)), s * (1 + b * b / (r * r)), 2 * nu * s};
      });
}

TEST(P04, ThickCylinder) {
  const auto s = verification::solve(body(2, 8, 4), inside());
  const auto inner = s.at({a, 0, 0}), outer = s.at({b, 0, 0});
  verification::check({"P04", "sigma_theta(a) [Pa]", 83333333.33, s.stress_Pa(1, inner)}, s, 0.01);
  verification::check({"P04", "sigma_theta(b) [Pa]", 33333333.33, s.stress_Pa(1, outer)}, s, 0.01);
  verification::check({"P04", "sigma_z(a) [Pa]", 10e6, s.stress_Pa(2, inner)}, s, 0.02);
  verification::check(
      {"P04", "von Mises(a) [Pa]", 115662343.8, verification::von_Mises(s.stress_Pa.col(inner))}, s, 0.01);
  verification::check({"P04", "u_r(a) [m]", 4.53968254e-05, s.displacement_m(0, inner)}, s, 0.002);
  verification::check({"P04", "u_r(b) [m]", 2.888888889e-05, s.displacement_m(0, outer)}, s, 0.002);
}

TEST(P04, ThickCylinderWithAFreeEnd) {
  auto free = body(2, 8, 4);
  free.clamps.pop_back();
  const auto s = verification::solve(free, inside());
  verification::check({"P04", "u_r(a), free ends [m]", 4.682539683e-05, s.displacement_m(0, s.at({a, 0, 0}))},
                      s, 0.002);
}

class P04Orders : public testing::TestWithParam<int> {};
TEST_P(P04Orders, DisplacementPPlus1AndStressP) {
  const int degree = GetParam(), n = degree == 1 ? 8 : 4;
  verification::expect_orders("P04", exact(), body(degree, n, n), body(degree, 2 * n, 2 * n), inside());
}
INSTANTIATE_TEST_SUITE_P(Q, P04Orders, testing::Values(1, 2, 3));

}  // namespace
