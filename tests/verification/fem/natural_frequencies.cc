// Natural frequencies: P11, P12, P13 and P16 of the public cases.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "fem/base/values/body_nodes.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using verification::Point;

constexpr fem::Material nafems_steel{200e9, 0.3, 8000};

struct Vibration {
  std::vector<fem::NaturalMode> modes;
  verification::Solution solution;  ///< size and seconds only
};

Vibration vibrate(const fem::Body& body, int n_modes) {
  Vibration result;
  const auto start = std::chrono::steady_clock::now();
  const fem::Model model(body);
  result.modes = model.natural_frequencies(n_modes);
  result.solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.solution.n_dofs = model.n_dofs();
  return result;
}

fem::Body box(const std::array<int, 3>& cells, const std::function<Point(const Point&)>& map, int degree) {
  fem::Body body;
  body.mesh = verification::hexahedra_of({cells, map});
  body.degree = degree;
  body.material = nafems_steel;
  return body;
}

void check(const std::string& name, const std::string& quantity, double reference_Hz, double ours_Hz,
           const Vibration& vibration, double tolerance) {
  verification::check({name, quantity + " [Hz]", reference_Hz, ours_Hz}, vibration.solution, tolerance);
}

// The beam's families of modes, each on the quarter y, z in [0, 1] of the 2 x 2 section: its symmetries are
// exact supports, where holding points or means is not (a point carries nothing in a solid).
fem::Body beam_quarter(const std::vector<fem::Clamp>& clamps) {
  auto body = box(
      {10, 2, 2}, [](const Point& c) { return Point(10 * c[0], c[1], c[2]); }, 2);
  body.clamps = clamps;
  return body;
}

constexpr int left = verification::begin_1, right = verification::end_1, at_y_0 = verification::begin_2,
              at_z_0 = verification::begin_3;

// Bends along z: its ends rest in their planes, its axis does not stretch.
TEST(P11, Flexural) {
  const auto v = vibrate(beam_quarter({{left, {false, true, true}},
                                       {right, {false, true, true}},
                                       {at_y_0, {false, true, false}},
                                       {at_z_0, {true, true, false}}}),
                         3);
  check("P11", "f1,2 flexural", 42.65, v.modes[0].frequency_Hz, v, 0.01);
  check("P11", "f5,6 flexural", 148.15, v.modes[1].frequency_Hz, v, 0.02);
  check("P11", "f8,9 flexural", 283.47, v.modes[2].frequency_Hz, v, 0.02);
}

TEST(P11, Torsional) {
  const auto v = vibrate(
      beam_quarter(
          {{left, {false, true, true}}, {at_y_0, {true, false, true}}, {at_z_0, {true, true, false}}}),
      2);
  check("P11", "f3 torsional", 71.1960867, v.modes[0].frequency_Hz, v, 0.01);
  check("P11", "f7 torsional", 213.58826, v.modes[1].frequency_Hz, v, 0.01);
}

TEST(P11, Extensional) {
  const auto v = vibrate(
      beam_quarter(
          {{left, {true, false, false}}, {at_y_0, {false, true, false}}, {at_z_0, {false, false, true}}}),
      1);
  check("P11", "f4 extensional", 125, v.modes[0].frequency_Hz, v, 0.005);
}

TEST(P12, TaperedMembrane) {
  auto body = box(
      {8, 4, 1}, [](const Point& c) { return Point(10 * c[0], (c[1] - 0.5) * (5 - 4 * c[0]), 0.05 * c[2]); },
      3);
  body.clamps = {{left, {true, true, false}}, {at_z_0, {false, false, true}}};
  const auto v = vibrate(body, 6);
  const double published_Hz[] = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
  const double elements_Hz[] = {44.617, 130.0095, 162.6887, 245.986, 379.717, 391.404};
  for (int i = 0; i < 6; ++i) {
    const auto name = "f" + std::to_string(i + 1);
    check("P12", name + ", NAFEMS", published_Hz[i], v.modes[i].frequency_Hz, v, 0.01);
    check("P12", name + ", spectral elements", elements_Hz[i], v.modes[i].frequency_Hz, v, 0.01);
  }
}

TEST(P13, ThickPlate) {
  auto body = box(
      {4, 4, 1}, [](const Point& c) { return Point(10 * c[0], 10 * c[1], c[2]); }, 3);
  body.clamps = {{left, {false, true, true}},
                 {right, {false, true, true}},
                 {at_y_0, {true, false, true}},
                 {verification::end_2, {true, false, true}}};
  const auto v = vibrate(body, 9);
  const auto f = [&](int number) { return v.modes[number - 1].frequency_Hz; };
  check("P13", "A f1", 45.9712116, f(1), v, 0.005);
  check("P13", "A f2", 109.8568617, f(2), v, 0.01);
  check("P13", "A f3", 109.8568617, f(3), v, 0.01);
  check("P13", "A f4, in-plane shear", 155.0434182, f(4), v, 0.005);
  check("P13", "A f5, in-plane shear", 155.0434182, f(5), v, 0.005);
  check("P13", "A f6", 168.819294, f(6), v, 0.01);
  check("P13", "A f9, in-plane", 219.2645048, f(9), v, 0.005);
  // The mesh has the plate's symmetry: pairs differ by rounding, eps times the highest over these w^2.
  EXPECT_NEAR(f(3) / f(2), 1, 1e-8);
  EXPECT_NEAR(f(5) / f(4), 1, 1e-8);
}

/// Frequencies of a round rod's modes by their kind: of torsion, moving along the axis, and the others.
struct RodModes {
  std::vector<double> torsion_Hz, axial_Hz, bending_Hz;
};
RodModes sort_rod_modes(const std::vector<fem::NaturalMode>& modes, const fem::Nodes& nodes) {
  RodModes rod;
  for (const auto& mode : modes) {
    double all = 0, around = 0, along = 0;
    for (std::size_t i = 0; i < nodes.n; ++i) {
      const double *u = &mode.shape[3 * i], *x = &nodes.xyz_m[3 * i], r = std::hypot(x[0], x[1]);
      const double turn = r > 0 ? (x[0] * u[1] - x[1] * u[0]) / r : 0;
      all += u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
      around += turn * turn;
      along += u[2] * u[2];
    }
    auto& kind = around > 0.9 * all ? rod.torsion_Hz : along > 0.9 * all ? rod.axial_Hz : rod.bending_Hz;
    kind.push_back(mode.frequency_Hz);
  }
  return rod;
}

TEST(P16, FreeRoundBar) {
  meshes::Shaft shaft;
  shaft.segments = {{"bar", 0, 0.4, 0.02, 0, false}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  control.largest_cell_m = 0.02;
  auto body = fem_tests::build(shaft, control).body;
  body.material = {210e9, 0.3, 7850};
  const auto v = vibrate(body, 21);
  const auto rod = sort_rod_modes(v.modes, fem::body_nodes(body));
  ASSERT_GE(rod.torsion_Hz.size(), 3u);
  ASSERT_GE(rod.axial_Hz.size(), 2u);
  ASSERT_GE(rod.bending_Hz.size(), 6u);
  check("P16", "torsion 1", 4009.573306, rod.torsion_Hz[0], v, 0.002);
  check("P16", "torsion 2", 8019.146613, rod.torsion_Hz[1], v, 0.003);
  check("P16", "torsion 3", 12028.71992, rod.torsion_Hz[2], v, 0.005);
  check("P16", "axial 1", 6464.344492, rod.axial_Hz[0], v, 0.002);
  check("P16", "axial 2", 12923.27864, rod.axial_Hz[1], v, 0.003);
  const double bending_Hz[] = {571.8077987, 1557.945965, 3004.404885};
  for (int i = 0; i < 3; ++i) {
    const auto name = "bending " + std::to_string(i + 1);
    check("P16", name + ", first of the pair", bending_Hz[i], rod.bending_Hz[2 * i], v, i < 2 ? 0.005 : 0.01);
    check("P16", name + ", second", bending_Hz[i], rod.bending_Hz[2 * i + 1], v, i < 2 ? 0.005 : 0.01);
    // The mesh comes back to itself after a quarter turn, so the pair differs by rounding alone.
    EXPECT_NEAR(rod.bending_Hz[2 * i + 1] / rod.bending_Hz[2 * i], 1, 1e-7);
  }
}

}  // namespace
