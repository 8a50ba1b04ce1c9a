// Cook's membrane: P21 of the public cases. A tapered panel, held at its left side, sheared at its right one.
#include <gtest/gtest.h>

#include <cmath>

#include "block_mesh.h"
#include "figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

enum class Plane { stress, strain };

fem::Body membrane(Plane plane, double poisson_ratio, int degree, int n) {
  verification::Block block;
  block.cells = {n, n, 1};
  block.map = [](const Point& c) { return Point(48 * c[0], 44 * (c[0] + c[1]) - 28 * c[0] * c[1], c[2]); };
  fem::Body body;
  body.mesh = verification::write_hexahedra(block);
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

TEST(P21, plane_stress) {
  const auto s = sheared(membrane(Plane::stress, 1.0 / 3, 2, 8));
  verification::check({"P21", "plane stress, nu 1/3: v(48, 52)", 23.968, rise(s, 52)}, s, 0.005);
}

TEST(P21, plane_strain) {
  const auto s = sheared(membrane(Plane::strain, 1.0 / 3, 2, 8));
  verification::check({"P21", "plane strain, nu 1/3: v(48, 52)", 21.5246, rise(s, 52)}, s, 0.005);
  verification::check({"P21", "plane strain, nu 1/3: v(48, 60)", 22.6105, rise(s, 60)}, s, 0.005);
}

TEST(P21, nearly_incompressible) {
  const auto s = sheared(membrane(Plane::strain, 0.4999, 3, 8));
  verification::check({"P21", "plane strain, nu 0.4999: v(48, 52)", 18.511, rise(s, 52)}, s, 0.02);
  verification::check({"P21", "plane strain, nu 0.4999: v(48, 60)", 19.427, rise(s, 60)}, s, 0.02);
}

// The upper left corner, 108 degrees between a held and a free side, makes stress infinite: the displacement
// converges with one and a half orders on equal cells, whatever the degree.
TEST(P21, corner_takes_the_order) {
  for (const int degree : {1, 2, 3}) {
    const int n = 24 / degree;
    const auto coarse = sheared(membrane(Plane::strain, 1.0 / 3, degree, n / 4)),
               middle = sheared(membrane(Plane::strain, 1.0 / 3, degree, n / 2)),
               fine = sheared(membrane(Plane::strain, 1.0 / 3, degree, n));
    const double order =
        std::log2((rise(middle, 52) - rise(coarse, 52)) / (rise(fine, 52) - rise(middle, 52)));
    verification::check_order({"P21", "order of v(48, 52), Q" + std::to_string(degree), 1.5, order}, fine,
                              0.3, 0.4);
  }
}

}  // namespace
