// Cook's membrane: P21 of the public cases. A tapered panel, held at its left side, sheared at its right one.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

enum class Plane { stress, strain };
enum class Cells { equal, small_at_the_sides };

fem::Body membrane(Plane plane, double poisson_ratio, int degree, int n, Cells cells) {
  verification::Block block;
  block.cells = {n, n, 1};
  const auto place = [cells](double c) {
    return cells == Cells::equal ? c : (1 - std::cos(verification::pi * c)) / 2;
  };
  block.map = [place](const Point& c) {
    const double x = place(c[0]), y = place(c[1]);
    return Point(48 * x, 44 * (x + y) - 28 * x * y, c[2]);
  };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.degree = degree;
  body.material = {1, poisson_ratio, 1};
  body.clamps = {{verification::begin_1, {true, true, false}}, {verification::begin_3, {false, false, true}}};
  if (plane == Plane::strain) body.clamps.push_back({verification::end_3, {false, false, true}});
  return body;
}

verification::Solution sheared(const fem::Body& body) {
  return verification::solve(body,
                             {{verification::on_face(verification::end_1, {48, 52, 0.5}, Component::fy), 1}});
}

double rise(const verification::Solution& s, double y) {
  return s.displacement_m(1, s.at({48, y, 0}));
}

TEST(P21, PlaneStress) {
  const auto s = sheared(membrane(Plane::stress, 1.0 / 3, 2, 8, Cells::small_at_the_sides));
  verification::check({"P21", "plane stress, nu 1/3: v(48, 52)", 23.968, rise(s, 52)}, s, 0.005);
}

TEST(P21, PlaneStrain) {
  const auto s = sheared(membrane(Plane::strain, 1.0 / 3, 2, 12, Cells::small_at_the_sides));
  verification::check({"P21", "plane strain, nu 1/3: v(48, 52)", 21.5246, rise(s, 52)}, s, 0.005);
  verification::check({"P21", "plane strain, nu 1/3: v(48, 60)", 22.6105, rise(s, 60)}, s, 0.005);
}

TEST(P21, NearlyIncompressible) {
  const auto s = sheared(membrane(Plane::strain, 0.4999, 3, 8, Cells::small_at_the_sides));
  verification::check({"P21", "plane strain, nu 0.4999: v(48, 52)", 18.511, rise(s, 52)}, s, 0.02);
  verification::check({"P21", "plane strain, nu 0.4999: v(48, 60)", 19.427, rise(s, 60)}, s, 0.02);
}

/// Mean displacement of the loaded side along the load: twice the energy, per unit of the load.
std::pair<verification::Solution, double> compliance(const fem::Body& body) {
  auto s = sheared(body);
  const auto side = verification::on_face(verification::end_1, {48, 52, 0.5}, Component::fy).surface;
  const Eigen::VectorXd force = fem::unit_resultants(fem::make_grid(body), side).col(1);
  const double mean = force.dot(s.displacement_m.reshaped());
  return {std::move(s), mean};
}

// The upper left corner, 108 degrees between a held and a free side, makes stress infinite, as
// r^(lambda - 1): lambda = 0.626 is the smallest root of Williams' equation for these sides,
//   sin^2(lambda alpha) = (kappa + 1)^2 / (4 kappa) - lambda^2 sin^2(alpha) / kappa,  kappa = 3 - 4 nu.
// On equal cells the energy converges with the order 2 lambda = 1.25 in the end, whatever the degree; the
// regular part of the error, of order 2 p, still helps on these meshes.
class P21Orders : public testing::TestWithParam<int> {};
TEST_P(P21Orders, OfTheEnergyIsTheCorners) {
  const int degree = GetParam(), n = 8 / degree;
  const auto at = [&](int cells) {
    return compliance(membrane(Plane::strain, 1.0 / 3, degree, cells, Cells::equal));
  };
  const auto coarse = at(n), middle = at(2 * n), fine = at(4 * n);
  const double order = std::log2((middle.second - coarse.second) / (fine.second - middle.second));
  verification::check_order(
      {"P21", "order of the energy at a corner, Q" + std::to_string(degree), 1.25, order}, fine.first, 0.1,
      0.35);
}
INSTANTIATE_TEST_SUITE_P(Q, P21Orders, testing::Values(2, 3));

}  // namespace
