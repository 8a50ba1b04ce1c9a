#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

/// Coordinates are written with 16 decimal digits; a few operations on them round at 1e-15 of the shaft's
/// size.
const double relative = 1e-12;

std::map<int, std::set<int>> nodes_by_group(const MeshFile& mesh) {
  std::map<int, std::set<int>> nodes;
  for (const auto& quad : mesh.quads) nodes[quad.group].insert(quad.nodes.begin(), quad.nodes.end());
  return nodes;
}

/// The segment whose surface the feature is: the longest segment name that begins the feature's name.
const meshes::ShaftSegment& segment_of(const meshes::Shaft& shaft, const std::string& feature) {
  for (const auto& segment : shaft.segments)
    if (feature == segment.name || feature.rfind(segment.name + " rim", 0) == 0) return segment;
  throw std::runtime_error("no segment for " + feature);
}

void expect_on_surfaces(const meshes::Shaft& shaft, const std::string& name) {
  SCOPED_TRACE(name);
  const auto body = meshes::build_shaft(shaft, {});
  const MeshFile mesh = read_mesh_file(body);
  const auto groups = nodes_by_group(mesh);
  const double size = shaft.segments.back().end_m - shaft.segments.front().begin_m;
  ASSERT_EQ(groups.size(), body.features.size());

  for (const auto& feature : body.features) {
    SCOPED_TRACE(feature.name);
    ASSERT_EQ(mesh.boundary_names.at(feature.boundary_id), feature.name);
    const auto& nodes = groups.at(feature.boundary_id);
    double first_z = 1e300, last_z = -1e300;
    for (const int node : nodes) {
      first_z = std::min(first_z, mesh.z(node));
      last_z = std::max(last_z, mesh.z(node));
      double error = 0;
      if (feature.kind == meshes::Feature::Kind::seat || feature.kind == meshes::Feature::Kind::surface) {
        const auto& segment = segment_of(shaft, feature.name);
        const double ecc = segment.eccentricity_m, angle = segment.eccentricity_angle_rad;
        error = std::hypot(mesh.x(node) - ecc * std::cos(angle), mesh.y(node) - ecc * std::sin(angle)) -
                0.5 * segment.diameter_m;
      } else if (feature.kind == meshes::Feature::Kind::bore) {
        error = std::hypot(mesh.x(node), mesh.y(node)) -
                0.5 * segment_of(shaft, feature.name.substr(5)).bore_m;  // "bore <segment>"
      } else if (feature.kind == meshes::Feature::Kind::fillet) {
        for (const auto& torus : body.tori)
          if (torus.boundary_id == feature.boundary_id)
            error = std::hypot(mesh.z(node) - torus.centre_z_m,
                               std::hypot(mesh.x(node), mesh.y(node)) - torus.centre_radius_m) -
                    torus.radius_m;
      }
      ASSERT_NEAR(error, 0, relative * size);
    }
    // Shoulders and end faces: begin = end, so this puts all their nodes in the plane.
    EXPECT_NEAR(first_z, feature.begin_m, relative * size);
    EXPECT_NEAR(last_z, feature.end_m, relative * size);
  }
}

TEST(BoundaryNodes, LieExactlyOnCylindersToriAndPlanes) {
  expect_on_surfaces(laboratory_shaft(), "on_laboratory");
  expect_on_surfaces(shoulder_shaft(2, 0.1), "on_shoulder");
  expect_on_surfaces(shoulder_shaft(1.1, 0.05), "on_full_step");
  expect_on_surfaces(three_steps(), "on_three_steps");
  expect_on_surfaces(sharp_eccentric_shaft(), "on_sharp_eccentric");
  expect_on_surfaces(planetary_drum(), "on_drum");
  expect_on_surfaces(two_eccentrics(), "on_two_eccentrics");
  expect_on_surfaces(grooved_shaft(), "on_grooved");
  for (const auto& shaft : stepped_bores()) expect_on_surfaces(shaft, "on_stepped_bore");
}

/// The tori of the tables against the drawing: centre one fillet away from the shoulder and from the small
/// cylinder.
TEST(BoundaryNodes, ToriAreThoseOfTheDrawing) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  ASSERT_EQ(body.tori.size(), 7u);
  const double tiny = 1e-15;                            // sums of a few numbers below 1 m
  EXPECT_NEAR(body.tori[3].centre_z_m, -0.0325, tiny);  // 42 / 60, radius 2.5, on the left of the seat
  EXPECT_NEAR(body.tori[3].centre_radius_m, 0.0235, tiny);
  EXPECT_NEAR(body.tori[3].radius_m, 0.0025, tiny);
  EXPECT_NEAR(body.tori[6].centre_z_m, 0.1925, tiny);  // 30 / 35, radius 1, the thick side on the left
  EXPECT_NEAR(body.tori[6].centre_radius_m, 0.016, tiny);
}

}  // namespace
