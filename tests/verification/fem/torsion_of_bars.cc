// Saint-Venant torsion of a square and a rectangular bar: P07 of the public cases. A quarter of the section,
// half the length: torsion turns over in the planes x = 0, y = 0 and z = 0, where only the displacement
// across the plane (x = 0, y = 0), or along it (z = 0), stays. What the end's traction differs from
// Saint-Venant's dies out along the bar; figures are taken near z = 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

constexpr fem::Material steel{208e9, 0.3, 7850};  // a shear modulus of 80 GPa
constexpr double shear_modulus_Pa = 80e9, torque_Nm = 100;

struct Section {
  double width_m, height_m;
};

struct Torsion {
  verification::Solution solution;
  double inertia_m4 = 0;
};

/// Twists the quarter bar by a traction e_z x r; cells across at will, one per half height along.
Torsion twist(const Section& section, int degree, int n) {
  const double x = section.width_m / 2, y = section.height_m / 2, length_m = 8 * x;
  constexpr int n_along = 8;
  verification::Block block;
  block.cells = {n, n, n_along};
  block.map = [=](const Point& c) { return Point(x * c[0], y * c[1], length_m * c[2]); };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.material = steel;
  body.degree = degree;
  body.clamps = {{verification::begin_1, {false, true, true}},
                 {verification::begin_2, {true, false, true}},
                 {verification::begin_3, {true, true, false}}};
  // (-y, x) = e_z x (r - c) + (-c_y, c_x), about the quarter's centre c, scaled to a quarter of the torque.
  const Point centre(x / 2, y / 2, length_m);
  const double area = x * y, scale = torque_Nm / 4 / (area * (x * x + y * y) / 3);
  const auto end = [&](Component component) {
    return verification::on_face(verification::end_3, centre, component);
  };
  Torsion result;
  result.solution =
      verification::solve(body, {{end(Component::fx), -scale * area * y / 2},
                                 {end(Component::fy), scale * area * x / 2},
                                 {end(Component::torque), scale * area * (x * x + y * y) / 12}});
  const double z_m = length_m / n_along;
  const double twist_rad_m = result.solution.displacement_m(1, result.solution.at({x, 0, z_m})) / x / z_m;
  result.inertia_m4 = torque_Nm / shear_modulus_Pa / twist_rad_m;
  return result;
}

TEST(P07, SquareBar) {
  const auto t = twist({0.02, 0.02}, 2, 4);
  verification::check({"P07", "square: J [m4]", 2.249232239e-8, t.inertia_m4}, t.solution, 0.005);
  const double tau = t.solution.stress_Pa(4, t.solution.at({0.01, 0, 0.01}));
  verification::check({"P07", "square: largest tau [Pa]", 60048444.22, tau}, t.solution, 0.01);
}

TEST(P07, RectangularBar) {
  const auto t = twist({0.04, 0.02}, 2, 4);
  verification::check({"P07", "40 x 20: J [m4]", 7.317813668e-8, t.inertia_m4}, t.solution, 0.005);
  const double tau = -t.solution.stress_Pa(5, t.solution.at({0, 0.01, 0.02}));
  verification::check({"P07", "40 x 20: largest tau [Pa]", 25419074.93, tau}, t.solution, 0.01);
}

// The twist is an energy: order 2 p. Warping has a singularity r^2 log r in the corners of the section, which
// ends this at 4: cubic cells gain nothing in the order.
class P07Orders : public testing::TestWithParam<int> {};
TEST_P(P07Orders, OfTheTwistAre2PBut4AtMost) {
  const int degree = GetParam(), n = 2;
  const double exact = 2.249232239e-8;
  const auto coarse = twist({0.02, 0.02}, degree, n), fine = twist({0.02, 0.02}, degree, 2 * n);
  const double order = std::log2(std::abs(coarse.inertia_m4 - exact) / std::abs(fine.inertia_m4 - exact));
  verification::check_order(
      {"P07", "order of J, Q" + std::to_string(degree), std::min(2.0 * degree, 4.0), order}, fine.solution,
      0.4, 0.4);
}
INSTANTIATE_TEST_SUITE_P(Q, P07Orders, testing::Values(1, 2, 3));

}  // namespace
