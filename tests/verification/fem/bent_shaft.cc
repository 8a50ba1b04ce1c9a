// A round cantilever with a force at its end: P10 of the public cases.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;

constexpr double diameter_m = 0.04, length_m = 0.4, force_N = 1000;

TEST(P10, Cantilever) {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, length_m, diameter_m, 0, false}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  control.largest_cell_m = diameter_m / 2;  // longer cells miss the clamped end's constraint: 0.5 % stiff
  auto built = fem_tests::build(shaft, control);
  built.body.material = {210e9, 0.3, 7850};
  built.body.clamps = {{built.ports.at("end_1").boundary_id, {true, true, true}}};
  const auto s = verification::solve(
      built.body, {{fem::SurfaceResultant{built.ports.at("end_2"), Component::fx}, force_N}});
  const double deflection_m = s.displacement_m(0, s.at({0, 0, length_m}));
  verification::check({"P10", "tip deflection, elastic solution [m]", 0.000808057919, deflection_m}, s,
                      0.005);
  verification::check({"P10", "tip deflection, Timoshenko [m]", 0.0008128522935, deflection_m}, s, 0.01);
  // Bending stress is linear in z: what the node nearest to the middle says of the middle.
  Eigen::Index node = 0;
  const Eigen::Vector3d middle(-diameter_m / 2, 0, length_m / 2);
  (s.place_m.colwise() - middle).colwise().norm().minCoeff(&node);
  ASSERT_NEAR(s.place_m(0, node), middle[0], 1e-9);
  const double at_middle = s.stress_Pa(2, node) * middle[2] / (length_m - s.place_m(2, node));
  verification::check({"P10", "bending stress at L/2 [Pa]", 31830988.62, at_middle}, s, 0.01);
}

}  // namespace
