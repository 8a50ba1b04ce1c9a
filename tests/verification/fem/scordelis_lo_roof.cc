// The Scordelis-Lo roof under its weight: P14 of the public cases. A quarter, as a solid; units of the source
// (foot, pound).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using verification::Point;

constexpr double radius = 25, half_length = 25, thickness = 0.25, half_angle = 40 * verification::pi / 180;

/// Sides: angle from the crown (1), radius (2), z from the middle of the length (3).
fem::Body roof(int degree, int n_around, int n_through, int n_along) {
  verification::Block block;
  block.cells = {n_around, n_through, n_along};
  block.map = [](const Point& c) {
    const double angle = half_angle * c[0], r = radius + thickness * (c[1] - 0.5);
    return Point(r * std::sin(angle), r * std::cos(angle), half_length * c[2]);
  };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.degree = degree;
  body.material = {4.32e8, 0, 360};
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  body.cylinders = {chart};
  body.clamps = {{verification::begin_1, {true, false, false}},
                 {verification::begin_3, {false, false, true}},
                 {verification::end_3, {true, true, false}}};
  return body;
}

double sag(const verification::Solution& s) {
  return s.displacement_m(1, s.at({radius * std::sin(half_angle), radius * std::cos(half_angle), 0}));
}

TEST(P14, Roof) {
  const auto s =
      verification::solve(roof(3, 6, 2, 6), {{fem::BodyForce{fem::BodyForce::Field::translation_y}, -1}});
  verification::check({"P14", "middle of the free edge, solid [ft]", -0.301474, sag(s)}, s, 0.01);
  verification::check({"P14", "middle of the free edge, shell [ft]", -0.3024, sag(s)}, s, 0.02);
}

}  // namespace
