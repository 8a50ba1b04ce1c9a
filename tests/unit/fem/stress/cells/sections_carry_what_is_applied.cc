// A section of a shaft under a load on its upper end carries that load, whatever lies between: moments and
// torques.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fem/base/values/constants.h"
#include "fem/models/solid/model.h"
#include "fem/stress/cells/sections.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using fem::pi;

struct Sections : testing::Test {
  static void SetUpTestSuite() {
    shaft = new fem_tests::ShaftBody(fem_tests::eccentric_shaft());
    std::vector<fem::UnitLoad> loads;
    for (const auto* end : {"end_1", "end_2"})
      for (const auto c :
           {Component::fx, Component::fy, Component::fz, Component::mx, Component::my, Component::torque})
        loads.push_back(fem_tests::resultant(*shaft, end, c));
    responses = fem::Model(shaft->body).unit_responses(loads, shaft->planes);
  }
  static void TearDownTestSuite() { delete shaft; }
  static fem_tests::ShaftBody* shaft;
  static fem::UnitResponses responses;
};
fem_tests::ShaftBody* Sections::shaft;
fem::UnitResponses Sections::responses;

TEST_F(Sections, FillTheirDiscs) {
  ASSERT_FALSE(responses.planes.empty());
  for (std::size_t p = 0; p < responses.planes.size(); ++p) {
    const double disc = pi * std::pow(responses.planes[p].radius_m, 2);
    EXPECT_NEAR(responses.plane_area_m2[p], disc, 2e-3 * disc);  // 8 parabolas: 1.2e-3
  }
}

// Recovered stress is not in exact equilibrium. On this coarse mesh, 8 sectors and two cells per 45 degrees
// of fillet, it is to 1.5 %; a shear force beside a bending moment of 4 diameters to 5 %.
TEST_F(Sections, CarryForceMomentAndTorque) {
  const double top = 0.06, bottom = -0.06, tolerance = 0.015;
  for (std::size_t p = 0; p < responses.planes.size(); ++p) {
    const double z = responses.planes[p].z_m;
    const auto pull = fem_tests::section(responses, {{"end_2.fz", 1}, {"end_1.fz", -1}}, p);
    EXPECT_NEAR(pull.resultant[2], 1, tolerance) << "z = " << z;
    const auto twist = fem_tests::section(responses, {{"end_2.torque", 1}, {"end_1.torque", -1}}, p);
    EXPECT_NEAR(twist.resultant[5], 1, tolerance) << "z = " << z;
    const auto bend = fem_tests::section(responses, {{"end_2.mx", 1}, {"end_1.mx", -1}}, p);
    EXPECT_NEAR(bend.resultant[3], 1, tolerance) << "z = " << z;
    // A force fy on top, -fy at the bottom, and the moment that closes: shear 1 N, mx about z = (top - z)
    // (-1).
    const auto shear =
        fem_tests::section(responses, {{"end_2.fy", 1}, {"end_1.fy", -1}, {"end_1.mx", top - bottom}}, p);
    EXPECT_NEAR(shear.resultant[1], 1, 0.05) << "z = " << z;
    EXPECT_NEAR(shear.resultant[3], -(top - z), tolerance * (top - bottom)) << "z = " << z;
  }
}

// Moments are about (0, 0, z) even where the section's own axis lies elsewhere: a central pull has none.
TEST_F(Sections, OfTheEccentricSeatTakeMomentsAboutTheZAxis) {
  int eccentric = 0;
  for (std::size_t p = 0; p < responses.planes.size(); ++p) {
    if (responses.planes[p].axis_x_m == 0) continue;
    ++eccentric;
    const auto pull = fem_tests::section(responses, {{"end_2.fz", 1}, {"end_1.fz", -1}}, p);
    EXPECT_NEAR(pull.resultant[3], 0, 1e-3 * 0.025);  // by symmetry
    EXPECT_NEAR(pull.resultant[4], 0, 0.01 * 0.025);
  }
  EXPECT_GT(eccentric, 0);
}

TEST(RodSections, RimAndRingsHaveTheTorsionalShear) {
  const auto rod = fem_tests::rod();
  const auto r = fem::Model(rod.body).unit_responses({fem_tests::resultant(rod, "end_1", Component::torque),
                                                      fem_tests::resultant(rod, "end_2", Component::torque)},
                                                     rod.planes);
  const double tau = 2 / (pi * std::pow(0.025, 3));
  const fem_tests::LoadCase twist = {{"end_2.torque", 1}, {"end_1.torque", -1}};
  for (std::size_t p = 0; p < r.planes.size(); ++p) {
    const auto s = fem_tests::section(r, twist, p);
    EXPECT_NEAR(s.mean_rim_shear_Pa[1], tau, 1e-3 * tau);
    EXPECT_NEAR(s.mean_rim_shear_Pa[0], 0, 1e-6 * tau);
  }
  ASSERT_GT(r.rings.size(), 10u);
  for (std::size_t i = 0; i < r.rings.size(); ++i) {
    EXPECT_NEAR(r.rings[i].radius_m, 0.025, 1e-12);
    EXPECT_TRUE(i == 0 || r.rings[i].z_m > r.rings[i - 1].z_m);
    EXPECT_EQ(r.rings[i].boundary_id, rod.features.at("rod"));
    EXPECT_NEAR(r.ring_shear_Pa[2 * i + 1][1] - r.ring_shear_Pa[2 * i][1], tau, 1e-3 * tau);
  }
}

TEST_F(Sections, RingsLeaveOutTheEccentricSeatAndKnowFillets) {
  int on_fillets = 0;
  for (const auto& ring : responses.rings) {
    EXPECT_NE(ring.boundary_id, shaft->features.at("seat"));
    for (const auto& torus : shaft->body.tori)
      if (ring.boundary_id == torus.boundary_id) {
        ++on_fillets;
        EXPECT_NEAR(std::hypot(ring.radius_m - torus.centre_radius_m, ring.z_m - torus.centre_z_m),
                    torus.radius_m, 1e-12);
      }
  }
  EXPECT_GE(on_fillets, 2 * 9);  // four cells per quarter: nine nodes
}

TEST_F(Sections, PlanesWithoutFacesAreRefused) {
  const fem::Model model(shaft->body);
  const std::vector<fem::UnitLoad> loads = {fem_tests::resultant(*shaft, "end_1", Component::fz)};
  const auto message = [&](const fem::SectionPlane& plane) -> std::string {
    try {
      model.unit_responses(loads, {plane});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message({0.0512345, 0.015, 0, 0}).find("no cell faces"), std::string::npos);
  auto plane = responses.planes.front();
  plane.radius_m *= 1.1;
  EXPECT_NE(message(plane).find("of the area of the disc"), std::string::npos);
}

// Means over circles that have nodes at unlike distances, as locally refined bodies do.
double mean_on_circle(const std::vector<double>& weights, const std::vector<double>& angles_rad, int order,
                      double phase_rad) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum += weights[i] * std::cos(order * angles_rad[i] - phase_rad);
  return sum;
}

/// Sixteen even nodes, and some more between a few of them.
std::vector<double> refined_on_one_side(int n_more) {
  std::vector<double> angles;
  for (int i = 0; i < 16; ++i) {
    angles.push_back(-pi + i * pi / 8);
    for (int k = 1; i < n_more && k < 4; ++k) angles.push_back(-pi + (i + k / 4.0) * pi / 8);
  }
  return angles;
}

// The shear stress of a lateral force is a sine round the shaft, many times that of a small torque. Halves of
// the gaps left 0.4 % of the sine and 1.2 % of its third harmonic with gaps of 22.5 and 5.6 degrees, so that
// a torsional stress of 3.0 MPa was 7.2.
TEST(MeansAroundCircles, OfHarmonicsAreNone) {
  for (const int n_more : {0, 1, 3, 8, 13}) {
    const auto angles = refined_on_one_side(n_more);
    const auto weights = fem::weights_around(angles);
    ASSERT_EQ(weights.size(), angles.size());
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-14);
    for (const double weight : weights) EXPECT_GE(weight, 0);
    for (const int order : {1, 2, 3, 4})
      for (const double phase : {0.0, 0.7})
        EXPECT_NEAR(mean_on_circle(weights, angles, order, phase), 0, 1e-12)
            << n_more << " more, order " << order;
  }
}

TEST(MeansAroundCircles, OfEvenNodesCountAlike) {
  for (const double weight : fem::weights_around(refined_on_one_side(0))) EXPECT_NEAR(weight, 1. / 16, 1e-15);
}

TEST(MeansAroundCircles, NeedNodesAllAround) {
  EXPECT_TRUE(fem::weights_around({0, 1, 2, 3}).empty());
}

}  // namespace
