/// Submodels of a body whose displacement is known: what its nodes say wrongly, they find.
#include <gtest/gtest.h>

#include "pipelines/judge/estimates/submodels.h"
#include "tests/unit/pipelines/examples/results_bar.h"

using namespace pipelines;

namespace {

constexpr double exaggeration = 1.2;

/// A cube bent about y: 100 MPa times x along z, a quadratic displacement. The nodes' own stress says 1.2
/// times that.
fem::UnitResponses bent_cube() {
  fem::UnitResponses responses;
  responses.channels = {"bend"};
  responses.nodes = results_test::mapped_cube(6, 6, 6, [](results_test::Point x) { return x; });
  const double k = 100e6 / 200e9, nu = 0.3;
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    const double *p = &responses.nodes.xyz_m[3 * i], x = p[0], y = p[1], z = p[2];
    for (const double u : {k * (nu * (y * y - x * x) - z * z) / 2, -nu * k * x * y, k * x * z})
      responses.displacement_m.push_back(u);
    for (const double s : {0.0, 0.0, exaggeration * 100e6 * x, 0.0, 0.0, 0.0})
      responses.stress_Pa.push_back(s);
  }
  return responses;
}

/// Held at both ends, so that they keep the displacement that they have.
fem::Body steel_body() {
  fem::Body body;
  body.material = {200e9, 0.3, 7850};
  body.clamps = {{4, {true, true, true}, {}}, {5, {true, true, true}, {}}};
  return body;
}

/// On the free face y = 0.
meshes::HotSpot toe(const std::string& name, double x) {
  return {name, 0.2, {x, 0, 2. / 3}, {x, 0, 0.5}, {x, 0, 1. / 3}};
}

BodyLoads one_load() {
  BodyLoads loads;
  fem::LoadSurface surface;
  surface.kind = fem::LoadSurface::Kind::face;
  surface.boundary_id = 5;
  loads.unit_loads = {{"bend", fem::SurfaceResultant{surface, fem::SurfaceResultant::Component::my}}};
  loads.history.values.resize(1, 2);
  loads.history.values << 0.5, -1;
  return loads;
}

}  // namespace

// Those that may lead if toes are half off: 20 MPa times 1.5 is less than the 50 that were found.
TEST(ResolvedToes, WhatMayLeadIsTheSubmodels) {
  const auto responses = bent_cube();
  const auto loads = one_load();
  const std::vector<meshes::HotSpot> drawn{toe("small", 1. / 6), toe("large", 0.5), toe("middle", 1. / 3)};
  auto spots = hot_spot_stresses(drawn, responses, loads.history);
  ASSERT_EQ(spots[0].name, "large");
  EXPECT_NEAR(spots[0].von_mises_Pa, exaggeration * 50e6, 1);
  resolve_hot_spots(drawn, responses, steel_body(), loads, spots);
  ASSERT_EQ(spots.size(), 3U);
  EXPECT_EQ(spots[0].name, "large");
  ASSERT_TRUE(spots[0].resolved && spots[1].resolved);
  EXPECT_NEAR(spots[0].von_mises_Pa, 50e6, 50);
  EXPECT_EQ(spots[0].instant, 1);
  EXPECT_NEAR(spots[0].max_normal_Pa, 25e6, 50);  // across the toe is along z
  EXPECT_NEAR(spots[0].min_normal_Pa, -50e6, 50);
  EXPECT_NEAR(spots[1].von_mises_Pa, 100e6 / 3, 50);
  EXPECT_FALSE(spots[2].resolved);
  EXPECT_NEAR(spots[2].von_mises_Pa, exaggeration * 100e6 / 6, 1);
}

// The place that reads 60 MPa is 10 MPa off, three halves of which are stated; finer cells and a wider rim
// change nothing.
TEST(ResolvedToes, ANodesErrorIsWhatTheSubmodelFinds) {
  const auto responses = bent_cube();
  const auto loads = one_load();
  const auto spot = hot_spot_stresses({toe("large", 0.5)}, responses, loads.history).front();
  const StressPoint point{{{spot.near_node, 1.0}}, 1};
  // Its cells reach to x = 2/3, where the stress is 66.7 MPa: the largest there is compared.
  EXPECT_NEAR(submodel_error_Pa(point, responses, steel_body(), loads, {}), 1.5 * (200e6 / 3 - 60e6), 100);
}

// Other loads, the same responses: what was solved is not solved again.
TEST(ResolvedToes, KnownOnesAreTaken) {
  const auto responses = bent_cube();
  const auto loads = one_load();
  const std::vector<meshes::HotSpot> drawn{toe("large", 0.5)};
  auto known = hot_spot_stresses(drawn, responses, loads.history);
  known[0].resolved = std::make_shared<ResolvedStress>(ResolvedStress{{{0, 0, 70e6, 0, 0, 0}}, 0.1});
  auto spots = hot_spot_stresses(drawn, responses, loads.history);
  resolve_hot_spots(drawn, responses, steel_body(), loads, spots, known);
  EXPECT_EQ(spots[0].resolved, known[0].resolved);
  EXPECT_NEAR(spots[0].von_mises_Pa, 70e6, 1);
}
