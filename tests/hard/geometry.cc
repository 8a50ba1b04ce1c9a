// Bodies with lengths of two or three orders side by side. References: closed forms (Lame, Jeffery, Euler,
// Timoshenko) and the power of the corner that a small fillet becomes (Williams).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fem/base/values/constants.h"
#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "fem/models/beam/fillet_factors.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/fem/examples/meridian_tube.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/distorted_beam.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

/// Two segments with a fillet or a sharp step between them, twisted at both ends.
struct TwistedStep {
  double small_m = 0, large_m = 0;  ///< diameters
  fem::MeridianBody body;
  fem::UnitResponses responses;

  TwistedStep(double d, double D, double fillet) : small_m(d), large_m(D) {
    meshes::Shaft shaft;
    shaft.segments = {{"thin", -1.5 * d, 0, d, 0, false}, {"thick", 0, 1.5 * D, D, 0, false}};
    shaft.fillets_m = {fillet};
    body = fem_tests::half_section(shaft, {});
    body.n_angles = 4;
    const auto ports = fem_tests::build(shaft, {}).ports;
    responses = fem::axisymmetric_responses(
        body, {{"1", fem::SurfaceResultant{ports.at("end_1"), Component::torque}},
               {"2", fem::SurfaceResultant{ports.at("end_2"), Component::torque}}});
  }
  double shear_Pa(std::size_t node) const {
    const auto s = fem_tests::stress(responses, {{"1", -1}, {"2", 1}}, node);
    return std::hypot(s[3], s[4], s[5]);
  }
  double largest_shear_Pa() const {
    double largest = 0;
    for (std::size_t i = 0; i < responses.nodes.n; ++i) largest = std::max(largest, shear_Pa(i));
    return largest;
  }
};

double torsion_Pa(double diameter_m) {
  return 16 / (fem::pi * diameter_m * diameter_m * diameter_m);
}

/// A ring of radii inner and outer, the outer circle moved along x.
fem::Body ring(double inner, double outer, double offset, std::array<int, 3> cells, double height) {
  verification::Block block;
  block.cells = cells;
  block.is_ring = true;
  block.map = [=](const Point& c) {
    const double r = inner + (outer - inner) * c[0], angle = 2 * fem::pi * c[1];
    return Point(r * std::cos(angle) + offset * c[0], r * std::sin(angle), height * c[2]);
  };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  chart.shift_x_m = offset;
  chart.inner_radius_m = inner;
  chart.outer_radius_m = outer;
  body.cylinders = {chart};
  body.material = {206e9, 0, 7850};
  return body;
}

/// Hoop stress under a pressure of 1 from inside, at a node of the inner circle.
double hoop_inside_Pa(const fem::Body& body, double inner, double height, const Point& place,
                      fem::Solver solver = fem::Solver::direct) {
  const auto s = verification::solve(
      body, {{verification::uniform_pressure(verification::begin_1, {0, 0, height / 2}, height), 1}},
      fem::Recovery::patch, solver);
  const auto t = s.stress_Pa.col(s.at(place));
  const double c = place[0] / inner, n = place[1] / inner;
  return n * n * t[0] + c * c * t[1] - 2 * n * c * t[3];
}

}  // namespace

// A fillet much smaller than its shoulder is a corner of 270 degrees but for its own size: in torsion the
// stress goes with r^(-1/3) (Williams 1952, anti-plane). r / h = 1/50 is not nothing: 0.2 %, measured.
TEST(HardGeometry, FilletOfATwoHundredth) {
  const double d = 0.03, D = 1.5 * d, r = d / 200;
  const double wanted = std::cbrt(2.0);
  const double ours = TwistedStep(d, D, r / 2).largest_shear_Pa() / TwistedStep(d, D, r).largest_shear_Pa();
  const double charts = fem::fillet_factors(d, D, r / 2).torsion / fem::fillet_factors(d, D, r).torsion;
  hard_cases::check({"geometry", "fillet of d / 200: what half its radius adds",
                     "beyond all charts and their fits", "DIN 743", hard_cases::relative(charts, wanted),
                     hard_cases::relative(ours, wanted), 0.005});
}

// Torsion of both sides, a diameter away from the step.
TEST(HardGeometry, StepOfAThousandth) {
  const double d = 0.03, D = 1.001 * d;
  const TwistedStep step(d, D, 0);
  double ours = 0, naive = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < step.responses.nodes.n; ++i) {
    const double* x = &step.responses.nodes.xyz_m[3 * i];
    const double side = x[2] < 0 ? d : D;
    if (std::abs(x[2]) < d || std::hypot(x[0], x[1]) < side / 2 * (1 - 1e-9)) continue;
    ++n;
    ours = std::max(ours, hard_cases::relative(step.shear_Pa(i), torsion_Pa(side)));
    naive = std::max(naive, hard_cases::relative(torsion_Pa((d + D) / 2), torsion_Pa(side)));
  }
  EXPECT_GT(n, 8u);
  // The step's own field has faded to exp(-5.1 / 1) of a thousandth a diameter away.
  hard_cases::check({"geometry", "step of 1 : 1.001", "nodes 15 um apart on a body of 90 mm",
                     "the step merged away, one mean diameter", naive, ours, 3e-5});
}

// Lame, (b^2 + a^2) / (b^2 - a^2). The circle of cells of degree 2 is off by (pi / n)^4 / 100 of the radius,
// five hundred times as much of the wall: below 1e-5.
TEST(HardGeometry, RingOfAFiveHundredth) {
  const double a = 0.5, b = a * (1 + 1.0 / 500), height = 0.01;
  auto body = ring(a, b, 0, {1, 64, 1}, height);
  const double exact = (b * b + a * a) / (b * b - a * a), ours = hoop_inside_Pa(body, a, height, {a, 0, 0});
  body.cylinders.clear();
  const double straight = hoop_inside_Pa(body, a, height, {a, 0, 0});
  hard_cases::check({"geometry", "ring of a wall of R / 500 under pressure",
                     "facets bend it: the sagitta is as large as the wall", "64 cells with straight edges",
                     hard_cases::relative(straight, exact), hard_cases::relative(ours, exact), 1e-5});
}

// A cantilever two hundred times longer than thick: P L^3 / 3 E I and shear, 6 P L / 5 G A, which is 2e-5 of
// it. Cells of degree 3 have that; what is left is warping at the clamp and the loaded end.
TEST(HardGeometry, ShaftOfTwoHundredDiameters) {
  const double side = 0.01, length = 200 * side, e = 206e9;
  const auto deflection = [&](int degree) {
    auto body = verification::distorted_beam(Point(side, side, length), {1, 1, 40}, 0, {e, 0, 7850}, degree);
    body.clamps = {{verification::begin_3, {true, true, true}}};
    const auto s = verification::solve(
        body, {{verification::on_face(verification::end_3, {0, 0, length}, Component::fy), 1}});
    return s.displacement_m(1, s.at({side / 2, side / 2, length}));
  };
  const double area = side * side, second = area * area / 12;
  const double exact = length * length * length / (3 * e * second) + 6 * length / (5 * e / 2 * area);
  // Cells of degree 3 have the beam's cubic: what is left is rounding, eps times a condition number of some
  // 1e10. With the BLAS kernels of five processors it is 3.7e-7 to 1.1e-6, whether or not the solution is
  // corrected once more; ten times that is the bound.
  hard_cases::check({"geometry", "shaft 200 times longer than thick",
                     "bending is 4e4 times softer than tension", "cells of degree 1, which lock",
                     hard_cases::relative(deflection(1), exact), hard_cases::relative(deflection(3), exact),
                     1e-5});
}

// An eccentric ring under pressure from inside, at the thinnest place of its bore (Jeffery 1921; Timoshenko
// and Goodier, Theory of Elasticity, art. 66): 2 b^2 (b^2 + a^2 - 2 a e - e^2) / ((a^2 + b^2) (b^2 - a^2 - 2
// a e - e^2))
// - 1. The wall is 1 : 19 thin and thick.
TEST(HardGeometry, OffsetOfNineTenthsOfTheRing) {
  const double a = 0.1, b = 0.13, e = 0.9 * (b - a), height = 0.01;
  const double exact = 2 * b * b * (b * b + a * a - 2 * a * e - e * e) /
                           ((a * a + b * b) * (b * b - a * a - 2 * a * e - e * e)) -
                       1;
  // The outer circle moves along +x: thin at -x.
  const double ours = hoop_inside_Pa(ring(a, b, e, {6, 96, 1}, height), a, height, {-a, 0, 0});
  const double naive = (b * b + a * a) / (b * b - a * a);
  hard_cases::check({"geometry", "offset of nine tenths of the ring", "walls of 1 : 19 side by side",
                     "Lame's concentric ring", hard_cases::relative(naive, exact),
                     hard_cases::relative(ours, exact), 5e-3});
}
