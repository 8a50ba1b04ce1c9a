// NAFEMS LE1 (a membrane) and LE10 (a thick plate) between two ellipses, a quarter of each: P01 and P02 of
// the public cases. Quadratic tetrahedra, whose nodes lie on the ellipses.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

/// Quarter from the inner ellipse (2, 1) m to the outer one (3.25, 2.75) m, from z = 0; cells grow outwards
/// and away from the end of the long axis, where stress is asked for.
fem::Body quarter(double thickness_m, const std::array<int, 3>& cells) {
  verification::Block block;
  block.cells = cells;
  block.map = [thickness_m](const Point& c) {
    const double out = c[0] * (0.5 + 0.5 * c[0]), angle = verification::pi / 2 * c[1] * (0.6 + 0.4 * c[1]);
    return Point((2 + 1.25 * out) * std::cos(angle), (1 + 1.75 * out) * std::sin(angle), thickness_m * c[2]);
  };
  fem::Body body;
  body.mesh = verification::tetrahedra_of(block);
  body.material = {210e9, 0.3, 7850};
  body.clamps = {{verification::begin_2, {false, true, false}}, {verification::end_2, {true, false, false}}};
  return body;
}

TEST(P01, EllipticMembrane) {
  const double thickness_m = 0.1;
  auto body = quarter(thickness_m, {6, 10, 1});
  body.clamps.push_back({verification::begin_3, {false, false, true}});
  const auto solution = verification::solve(
      body,
      {{verification::uniform_pressure(verification::end_1, {0, 0, thickness_m / 2}, thickness_m), -10e6}});
  const double ours = solution.stress_Pa(1, solution.at({2, 0, 0}));
  verification::check({"P01", "sigma_yy at D, spectral elements [Pa]", 92.6582e6, ours}, solution, 0.02);
  verification::check({"P01", "sigma_yy at D, NAFEMS [Pa]", 92.7e6, ours}, solution, 0.02);
}

TEST(P02, ThickEllipticPlate) {
  auto body = quarter(0.6, {6, 8, 4});
  body.clamps.push_back({verification::end_1, {true, true, false}});
  body.clamps.push_back({verification::end_1, {false, false, true}, 0.3});
  // The centroid of the upper face: there a uniform traction has no moment.
  const double area_m2 = verification::pi / 4 * (3.25 * 2.75 - 2 * 1);
  const Point centroid((3.25 * 3.25 * 2.75 - 2 * 2 * 1) / 3 / area_m2,
                       (3.25 * 2.75 * 2.75 - 2 * 1 * 1) / 3 / area_m2, 0.6);
  const auto solution = verification::solve(
      body, {{verification::on_face(verification::end_3, centroid, Component::fz), -1e6 * area_m2}});
  const double ours = solution.stress_Pa(1, solution.at({2, 0, 0.6}));
  verification::check({"P02", "sigma_yy at D, spectral elements [Pa]", -5.37e6, ours}, solution, 0.03);
  verification::check({"P02", "sigma_yy at D, NAFEMS [Pa]", -5.38e6, ours}, solution, 0.03);
}

}  // namespace
