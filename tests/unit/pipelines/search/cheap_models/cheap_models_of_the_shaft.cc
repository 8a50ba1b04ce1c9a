// The cheap models of the shipped shaft: its mesh's features found on their nodes, statics in their stress.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fem/models/beam/beam_responses.h"
#include "pipelines/loads/channels/statics.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/superpose/envelope/zones.h"
#include "tests/unit/pipelines/examples/laboratory.h"

namespace {

using Component = fem::SurfaceResultant::Component;

const pipelines::BodyScene& shaft_of(const pipelines::Scene& scene) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [](const auto& body) { return body.name == "shaft"; });
}

struct ShippedShaft : testing::Test {
  pipelines::BodyScene body = shaft_of(laboratory::scene());
  meshes::BodyMesh mesh = pipelines::build_mesh(body);

  fem::UnitLoad load(const std::string& port, Component component, const char* name) const {
    const auto p =
        std::find_if(mesh.ports.begin(), mesh.ports.end(), [&](const auto& q) { return q.name == port; });
    fem::LoadSurface surface{fem::LoadSurface::Kind::seat,
                             p->boundary_id,
                             {p->axis_x_m, p->axis_y_m, (p->begin_m + p->end_m) / 2},
                             p->radius_m,
                             p->end_m - p->begin_m};
    return {port + name, fem::SurfaceResultant{surface, component}};
  }
  /// Bearings against the eccentric seat across, the coupling against it in torsion; closed.
  std::vector<fem::UnitLoad> loads{
      load("main_bearing_1", Component::fy, ".fy"), load("eccentric_seat", Component::fy, ".fy"),
      load("main_bearing_2", Component::fy, ".fy"), load("coupling", Component::torque, ".torque")};
  std::vector<double> closed{-0.5, 1, -0.5, -0.004};  // the seat's force has a lever of 4 mm about z

  pipelines::Stress sum(const fem::UnitResponses& r, std::size_t node) const {
    pipelines::Stress s{};
    for (std::size_t k = 0; k < closed.size(); ++k)
      for (std::size_t c = 0; c < 6; ++c) s[c] += closed[k] * r.stress_Pa[(node * closed.size() + k) * 6 + c];
    return s;
  }
  std::vector<double> von_mises(const fem::UnitResponses& r) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < r.nodes.n; ++i) result.push_back(pipelines::von_mises_Pa(sum(r, i)));
    return result;
  }
};

TEST_F(ShippedShaft, AsABeamCarriesWhatStaticsSays) {
  const auto r = pipelines::beam_responses(body, mesh, loads);
  ASSERT_TRUE(r);
  const auto places = pipelines::locate_nodes(r->nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  int compared = 0;
  for (const auto& segment : body.shaft()->geometry.segments)
    for (std::size_t i = 0; i < r->nodes.n; ++i) {
      const auto feature = std::size_t(places.feature[i]);
      if (places.feature_names[feature] != segment.name) continue;
      const double x = r->nodes.xyz_m[3 * i] - segment.eccentricity_m, y = r->nodes.xyz_m[3 * i + 1],
                   z = r->nodes.xyz_m[3 * i + 2];
      std::array<double, 6> w{};
      for (std::size_t k = 0; k < loads.size(); ++k) {
        const auto part =
            pipelines::internal_resultant(loads[k], body.shaft()->geometry, body.material.density_kg_m3, z);
        for (std::size_t c = 0; c < 6; ++c) w[c] += closed[k] * part[c];
      }
      const double R = segment.diameter_m / 2, area = M_PI * R * R, inertia = area * R * R / 4;
      const double torque = w[5] - segment.eccentricity_m * w[1];  // about the segment's own axis
      const auto s = sum(*r, i);
      EXPECT_NEAR(s[2], w[3] * y / inertia, 1e-9 * R / inertia);
      const double shear = torque * R / (2 * inertia) + 4.0 / 3 * w[1] / area * x / R;  // theta z
      EXPECT_NEAR(s[4] * x / R - s[5] * y / R, shear, 1e-9 / area);
      ++compared;
    }
  EXPECT_EQ(compared, 8 * 3 * 32);
}

TEST_F(ShippedShaft, AsABeamPeaksAtTheFilletOfTheEccentricSeat) {
  const auto r = pipelines::beam_responses(body, mesh, loads);
  ASSERT_TRUE(r);
  const auto places = pipelines::locate_nodes(r->nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  const auto value = von_mises(*r);
  const auto peak = pipelines::peak_node(value, places);
  const auto& name = places.feature_names[std::size_t(places.feature[peak])];
  EXPECT_TRUE(name == "fillet body_1/eccentric_seat" || name == "fillet eccentric_seat/body_2") << name;
  EXPECT_EQ(places.place[peak], pipelines::Place::free_surface);
}

TEST_F(ShippedShaft, AsHarmonicsStandsOnTheSurfaceOfTheMesh) {
  const auto model = pipelines::axisymmetric_responses(body, mesh, loads);
  ASSERT_TRUE(model);
  const auto& nodes = model->responses.nodes;
  const auto places = pipelines::locate_nodes(nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  std::vector<char> met(mesh.features.size(), 0);
  for (std::size_t i = 0; i < nodes.n; ++i) {
    if (places.feature[i] < 0) continue;  // inside
    const auto& feature = mesh.features[std::size_t(places.feature[i])];
    met[std::size_t(places.feature[i])] = 1;
    EXPECT_GE(nodes.xyz_m[3 * i + 2], feature.begin_m - 1e-9) << feature.name;
    EXPECT_LE(nodes.xyz_m[3 * i + 2], feature.end_m + 1e-9) << feature.name;
  }
  for (std::size_t f = 0; f < met.size(); ++f) EXPECT_TRUE(met[f]) << mesh.features[f].name;
}

// The beam's peak may miss that of the harmonics by what it states, and by what the harmonics state.
TEST_F(ShippedShaft, PeaksAlikeOnBothModels) {
  const auto beam = pipelines::beam_responses(body, mesh, loads);
  const auto model = pipelines::axisymmetric_responses(body, mesh, loads);
  ASSERT_TRUE(beam && model);
  const auto peak_of = [&](const fem::UnitResponses& r) {
    const auto places = pipelines::locate_nodes(r.nodes, mesh.features, mesh.ports, mesh.sharp_edges);
    const auto value = von_mises(r);
    const auto node = pipelines::peak_node(value, places);
    EXPECT_EQ(places.feature_names[std::size_t(places.feature[node])].substr(0, 6), "fillet");
    return value[node];
  };
  const double a = peak_of(*beam), b = peak_of(model->responses);
  std::printf("beam %.0f Pa, harmonics %.0f Pa: %+.2f %%; stated %.1f %% and %.1f %%\n", a, b,
              100 * (a / b - 1), 100 * fem::beam_model_error(*pipelines::beam_shaft(body, mesh)),
              100 * model->model_error);
  EXPECT_NEAR(a, b, (fem::beam_model_error(*pipelines::beam_shaft(body, mesh)) + model->model_error) * b);
  EXPECT_GT(model->model_error, 0);
}

TEST_F(ShippedShaft, HasNoCheapRungWithAKeyway) {
  std::get<pipelines::ShaftShape>(body.shape).keyways.emplace_back();
  EXPECT_FALSE(pipelines::beam_responses(body, mesh, loads));
  EXPECT_FALSE(pipelines::axisymmetric_responses(body, mesh, loads));
}

}  // namespace
