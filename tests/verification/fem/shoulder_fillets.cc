// Stress concentration of a shoulder fillet in a round shaft. References: an independent axisymmetric
// spectral element program, degrees 7 and 9 agreeing to 5 or 6 digits (public verification cases P08 and
// P09). Peterson's charts and their fits are not the reference: they lie up to 16 % below the elastic
// solution in tension.
//   torsion:          Kt = largest shear / (16 T / pi d^3)
//   bending, tension: Kt = largest principal stress / nominal on d
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
constexpr double pi = 3.14159265358979323846;

struct Case {
  double D, r;  // over d
  double torsion, bending, tension;
};
constexpr Case cases[] = {{1.1, 0.05, 1.432942, 1.89369, 2.01310}, {1.2, 0.05, 1.527733, 2.08932, 2.31102},
                          {1.2, 0.10, 1.333653, 1.70551, 1.88236}, {1.5, 0.05, 1.615949, 2.27198, 2.69193},
                          {1.5, 0.10, 1.379884, 1.80024, 2.11426}, {1.5, 0.20, 1.223835, 1.47689, 1.70313},
                          {2.0, 0.05, 1.641986, 2.32778, 2.89307}, {2.0, 0.10, 1.393175, 1.82423, 2.22890}};

/// Principal stresses, ascending: the trigonometric solution of the characteristic equation.
std::array<double, 3> principal(const std::array<double, 6>& s) {
  const double mean = (s[0] + s[1] + s[2]) / 3, xx = s[0] - mean, yy = s[1] - mean, zz = s[2] - mean;
  const double j2 = (xx * xx + yy * yy + zz * zz) / 2 + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  if (j2 == 0) return {{mean, mean, mean}};
  const double j3 =
      xx * (yy * zz - s[4] * s[4]) - s[3] * (s[3] * zz - s[4] * s[5]) + s[5] * (s[3] * s[4] - yy * s[5]);
  const double angle = std::acos(std::clamp(1.5 * std::sqrt(3.0) * j3 / std::pow(j2, 1.5), -1.0, 1.0)) / 3;
  const double size = 2 * std::sqrt(j2 / 3);
  return {{mean + size * std::cos(angle + 2 * pi / 3), mean + size * std::cos(angle - 2 * pi / 3),
           mean + size * std::cos(angle)}};
}

struct Factors {
  double torsion = 0, bending = 0, tension = 0;
  std::size_t n_dofs = 0;
  double seconds = 0;
};

/// Segments of 1.5 of their diameters; loads in opposite pairs on the two ends.
fem_tests::ShaftBody stepped_shaft(const Case& c, int cells_per_quarter) {
  const double d = 0.03, D = c.D * d;
  meshes::Shaft shaft;
  shaft.segments = {{"thin", -1.5 * d, 0, d, 0, false}, {"thick", 0, 1.5 * D, D, 0, false}};
  shaft.fillets_m = {c.r * d};
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = cells_per_quarter;
  return fem_tests::build(shaft, control);
}

Factors concentration(const fem_tests::ShaftBody& shaft, fem::Recovery recovery) {
  const double d = 0.03;
  std::vector<fem::UnitLoad> loads;
  for (const auto* end : {"end_1", "end_2"})
    for (const auto component : {Component::torque, Component::mx, Component::fz})
      loads.push_back(fem_tests::resultant(shaft, end, component));
  const auto start = std::chrono::steady_clock::now();
  const auto r = fem::Model(shaft.body).unit_responses(loads, {}, recovery);
  Factors factors;
  factors.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  factors.n_dofs = r.n_dofs;
  std::vector<char> on_fillet(r.nodes.n, 0);
  for (std::size_t f = 0; f < r.nodes.n_faces(); ++f)
    if (r.nodes.face_boundary_id[f] == shaft.body.tori.at(0).boundary_id)
      for (const auto node : r.nodes.face(f)) on_fillet[node] = 1;
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    if (!on_fillet[i]) continue;
    const auto p = [&](const char* component) {
      return principal(fem_tests::stress(
          r, {{std::string("end_2.") + component, 1}, {std::string("end_1.") + component, -1}}, i));
    };
    const auto twist = p("torque");
    factors.torsion = std::max(factors.torsion, (twist[2] - twist[0]) / 2 / (16 / (pi * d * d * d)));
    factors.bending = std::max(factors.bending, p("mx")[2] / (32 / (pi * d * d * d)));
    factors.tension = std::max(factors.tension, p("fz")[2] / (4 / (pi * d * d)));
  }
  return factors;
}

double print_row(const char* load, const Case& c, double reference, double patch, double average) {
  std::printf("%-8s D/d %.1f r/d %.2f  reference %.5f  patch %.5f (%+.2f %%)  average %.5f (%+.2f %%)\n",
              load, c.D, c.r, reference, patch, 100 * (patch / reference - 1), average,
              100 * (average / reference - 1));
  return std::abs(patch / reference - 1);
}

class ShoulderFillet : public testing::TestWithParam<Case> {};

TEST_P(ShoulderFillet, HasTheStressConcentrationOfTheElasticSolution) {
  const auto c = GetParam();
  const auto shaft = stepped_shaft(c, 8);
  const auto patch = concentration(shaft, fem::Recovery::patch);
  const auto average = concentration(shaft, fem::Recovery::average);
  // The default mesh, eight cells per quarter; the largest of these errors is 0.9 %.
  EXPECT_LT(print_row("torsion", c, c.torsion, patch.torsion, average.torsion), 0.01);
  EXPECT_LT(print_row("bending", c, c.bending, patch.bending, average.bending), 0.01);
  EXPECT_LT(print_row("tension", c, c.tension, patch.tension, average.tension), 0.01);
  std::printf("%zu unknowns\n", patch.n_dofs);
  char sizes[40];
  std::snprintf(sizes, sizeof sizes, ", D/d %.1f, r/d %.2f", c.D, c.r);
  const auto row = [&](const char* name, const char* load, double reference, double ours) {
    verification::add_row({name, std::string("Kt ") + load + sizes, reference, ours}, false, patch.n_dofs,
                          patch.seconds);
  };
  row("P08", "torsion", c.torsion, patch.torsion);
  row("P09", "bending", c.bending, patch.bending);
  row("P09", "tension", c.tension, patch.tension);
}

INSTANTIATE_TEST_SUITE_P(P08_P09, ShoulderFillet, testing::ValuesIn(cases), [](const auto& test) {
  return "D" + std::to_string(std::lround(100 * test.param.D)) + "_r" +
         std::to_string(std::lround(100 * test.param.r));
});

// A fillet of a hundredth of the diameter, h / r = 3. Source of the charts: Pilkey, Peterson's Stress
// Concentration Factors, shoulder fillets in round bars (coefficients in the public cases P08, P09). Where
// these cases have elastic solutions the charts are 2 % above them in torsion at h / r up to 4, up to 7 %
// below in bending and 16 % in tension; the bounds leave 4 % for the mesh.
constexpr Case sharp{1.06, 0.01, 1.918, 2.489, 2.487};

void expect_near_charts(const Factors& k) {
  EXPECT_NEAR(k.torsion, sharp.torsion, 0.04 * sharp.torsion);
  EXPECT_GT(k.bending, sharp.bending);
  EXPECT_LT(k.bending, 1.12 * sharp.bending);
  EXPECT_GT(k.tension, sharp.tension);
  EXPECT_LT(k.tension, 1.2 * sharp.tension);
}

TEST(ShoulderFilletOfAHundredth, IsMeshedAndNearTheCharts) {
  expect_near_charts(concentration(stepped_shaft(sharp, 4), fem::Recovery::patch));
}

TEST(ShoulderFilletOfAHundredthRefined, ChangesByWhatCoarseCellsMiss) {
  const auto coarse = concentration(stepped_shaft(sharp, 4), fem::Recovery::patch),
             fine = concentration(stepped_shaft(sharp, 8), fem::Recovery::patch);
  std::printf("torsion %.4f %.4f, bending %.4f %.4f, tension %.4f %.4f, %zu unknowns\n", coarse.torsion,
              fine.torsion, coarse.bending, fine.bending, coarse.tension, fine.tension, fine.n_dofs);
  expect_near_charts(fine);
  // Measured: 0.6 %, 3.8 %, 4.0 %.
  EXPECT_NEAR(coarse.torsion, fine.torsion, 0.01 * fine.torsion);
  EXPECT_NEAR(coarse.bending, fine.bending, 0.05 * fine.bending);
  EXPECT_NEAR(coarse.tension, fine.tension, 0.05 * fine.tension);
}

TEST(ShoulderFilletRefined, ComesCloser) {
  const auto& c = cases[3];
  const auto coarse = concentration(stepped_shaft(c, 8), fem::Recovery::patch);
  const auto shaft = stepped_shaft(c, 16);
  const auto fine = concentration(shaft, fem::Recovery::patch);
  const auto average = concentration(shaft, fem::Recovery::average);
  EXPECT_LT(print_row("torsion", c, c.torsion, fine.torsion, average.torsion),
            std::abs(coarse.torsion / c.torsion - 1));
  EXPECT_LT(print_row("bending", c, c.bending, fine.bending, average.bending),
            std::abs(coarse.bending / c.bending - 1));
  EXPECT_LT(print_row("tension", c, c.tension, fine.tension, average.tension),
            std::abs(coarse.tension / c.tension - 1));
  std::printf("%zu unknowns\n", fine.n_dofs);
}

}  // namespace
