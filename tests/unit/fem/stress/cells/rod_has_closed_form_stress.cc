// A plain rod with Saint-Venant's tractions on its ends has a stress known in closed form at every node. Two
// balanced unit loads, opposite on the two ends, add up to each case: what balanced each of them alone must
// cancel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/base/values/constants.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using Tensor = std::array<double, 6>;
using fem::pi;
constexpr double radius = 0.025;

struct Rod : testing::Test {
  static void SetUpTestSuite() {
    const auto body = fem_tests::rod();
    std::vector<fem::UnitLoad> loads;
    for (const auto* end : {"end_1", "end_2"})
      for (const auto c : {Component::fz, Component::mx, Component::my, Component::torque})
        loads.push_back(fem_tests::resultant(body, end, c));
    const fem::Model model(body.body);
    patch = model.unit_responses(loads, body.planes);
    average = model.unit_responses(loads, {}, fem::Recovery::average);
  }
  /// Largest error of any component at any node, relative to the largest exact one.
  template <typename Exact>
  static double error(const fem::UnitResponses& r, const fem_tests::LoadCase& sum, const Exact& exact) {
    double worst = 0, scale = 0;
    for (std::size_t i = 0; i < r.nodes.n; ++i) {
      const double* x = &r.nodes.xyz_m[3 * i];
      const Tensor ours = fem_tests::stress(r, sum, i), theirs = exact(x[0], x[1]);
      for (int c = 0; c < 6; ++c) {
        worst = std::max(worst, std::abs(ours[c] - theirs[c]));
        scale = std::max(scale, std::abs(theirs[c]));
      }
    }
    return worst / scale;
  }
  static fem::UnitResponses patch, average;
};
fem::UnitResponses Rod::patch, Rod::average;

// The displacement is linear, so the mesh adds nothing but its own area: 16 parabolas for the circle, 2e-5
// too small.
TEST_F(Rod, InTension) {
  const auto exact = [](double, double) { return Tensor{0, 0, 1 / (pi * radius * radius), 0, 0, 0}; };
  const fem_tests::LoadCase pull = {{"end_2.fz", 1}, {"end_1.fz", -1}};
  EXPECT_LT(error(patch, pull, exact), 1e-4);
  EXPECT_LT(error(average, pull, exact), 1e-4);
}

// u = twist z (-y, x, 0) is in the space; what is left is that the rim is not quite a circle.
TEST_F(Rod, InTorsion) {
  const double j = pi * std::pow(radius, 4) / 2;
  const auto exact = [j](double x, double y) { return Tensor{0, 0, 0, 0, x / j, -y / j}; };
  EXPECT_LT(error(patch, {{"end_2.torque", 1}, {"end_1.torque", -1}}, exact), 1e-3);
}

// Quadratic displacement on curved cells: the discretisation shows.
TEST_F(Rod, InBendingAboutBothAxes) {
  const double i = pi * std::pow(radius, 4) / 4;
  EXPECT_LT(error(patch, {{"end_2.mx", 1}, {"end_1.mx", -1}},
                  [i](double, double y) { return Tensor{0, 0, y / i, 0, 0, 0}; }),
            3e-3);
  EXPECT_LT(error(patch, {{"end_2.my", 1}, {"end_1.my", -1}},
                  [i](double x, double) { return Tensor{0, 0, -x / i, 0, 0, 0}; }),
            3e-3);
}

TEST_F(Rod, TwistStretchAndCurvatureBetweenSections) {
  const double e = fem_tests::steel.youngs_modulus_Pa, g = e / 2.6, area = pi * radius * radius,
               i = area * radius * radius / 4;
  const std::size_t last = patch.planes.size() - 1;
  const double length = patch.planes[last].z_m - patch.planes[0].z_m;
  ASSERT_GT(length, 0.1);
  const auto difference = [&](const fem_tests::LoadCase& sum, auto pick) {
    return pick(fem_tests::section(patch, sum, last)) - pick(fem_tests::section(patch, sum, 0));
  };
  const double twist =
      difference({{"end_2.torque", 1}, {"end_1.torque", -1}}, [](auto s) { return s.rotation_rad[2]; });
  EXPECT_NEAR(twist, length / (g * 2 * i), 1e-3 * length / (g * 2 * i));
  const double stretch =
      difference({{"end_2.fz", 1}, {"end_1.fz", -1}}, [](auto s) { return s.translation_m[2]; });
  EXPECT_NEAR(stretch, length / (e * area), 1e-4 * length / (e * area));
  // A moment +mx on the upper end pulls at y > 0 and turns the upper end about +x.
  const double slope =
      difference({{"end_2.mx", 1}, {"end_1.mx", -1}}, [](auto s) { return s.rotation_rad[0]; });
  EXPECT_NEAR(slope, length / (e * i), 1e-3 * length / (e * i));
}

}  // namespace
