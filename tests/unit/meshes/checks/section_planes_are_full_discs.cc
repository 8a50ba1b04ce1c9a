#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "meshes/shaft/shaft.h"
#include "meshes/shaft/shaft_description.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/faces.h"
#include "tests/unit/meshes/examples/random_bodies.h"
#include "tests/unit/meshes/examples/shaft_volume.h"

namespace {

void expect_full_discs(const meshes::Shaft& shaft, const std::string& name) {
  SCOPED_TRACE(name);
  const meshes::ShaftMeshControl control;
  const auto body = meshes::build_shaft(shaft, control);
  const MeshFile mesh = read_mesh_file(body);
  const auto faces = count_faces(mesh);
  const double size = shaft.segments.back().end_m - shaft.segments.front().begin_m;
  const double in_plane = 1e-12 * size;  // planes are at least 1e-5 of the length apart

  double previous = -1e300;
  for (const auto& section : body.sections) {
    SCOPED_TRACE("z = " + std::to_string(section.z_m));
    EXPECT_GT(section.z_m, previous);
    previous = section.z_m;
    std::array<double, 3> sums{};
    for (const auto& [key, use] : faces) {
      bool inside = use.n_cells == 2;  // a section has material on both sides everywhere
      for (const int node : key) inside = inside && std::abs(mesh.z(node) - section.z_m) < in_plane;
      if (!inside) continue;
      const auto face = area_and_moments(mesh, use.nodes);
      for (int i = 0; i < 3; ++i) sums[i] += face[i];
    }
    // The full polygon about the section's own axis, less the bore about z; sums of some hundred faces.
    const double area = polygon_area(section.radius_m, control.n_sectors);
    EXPECT_NEAR(sums[0], area - polygon_area(section.inner_radius_m, control.n_sectors), 1e-11 * area);
    EXPECT_NEAR(sums[1], area * section.axis_x_m, 1e-11 * area * section.radius_m);
    EXPECT_NEAR(sums[2], area * section.axis_y_m, 1e-11 * area * section.radius_m);
    for (const auto& segment : shaft.segments) {
      if (segment.name != section.segment) continue;
      EXPECT_EQ(section.radius_m, 0.5 * segment.diameter_m);
      EXPECT_EQ(section.inner_radius_m, 0.5 * segment.bore_m);
      const double ecc = segment.eccentricity_m, angle = segment.eccentricity_angle_rad;
      EXPECT_NEAR(section.axis_x_m, ecc * std::cos(angle), 1e-16);  // rounding of millimetres
      EXPECT_NEAR(section.axis_y_m, ecc * std::sin(angle), 1e-16);
      const double margin = std::min(section.z_m - segment.begin_m, segment.end_m - section.z_m);
      EXPECT_EQ(section.plain, margin >= section.radius_m * (1 - 1e-9));
    }
  }
}

TEST(SectionPlanes, AscendAndAreFullDiscsOfTheirSegment) {
  expect_full_discs(laboratory_shaft(), "sections_laboratory");
  expect_full_discs(three_steps(), "sections_three_steps");
  expect_full_discs(sharp_eccentric_shaft(), "sections_sharp_eccentric");
  expect_full_discs(shoulder_shaft(1.1, 0.05), "sections_shoulder");
  expect_full_discs(planetary_drum(), "sections_drum");
  expect_full_discs(two_eccentrics(), "sections_two_eccentrics");
  for (const auto& shaft : stepped_bores()) expect_full_discs(shaft, "sections_stepped_bore");
}

/// Every segment as long as its diameter has a plain section; so the seat, exactly as long, has one in its
/// middle.
TEST(SectionPlanes, IncludeAPlainOneInEachLongSegment) {
  const auto shaft = laboratory_shaft();
  for (const double largest_cell_m : {0.0, 0.2}) {
    meshes::ShaftMeshControl control;
    control.largest_cell_m = largest_cell_m;
    const auto body = meshes::build_shaft(shaft, control);
    for (const auto& segment : shaft.segments) {
      int n_plain = 0;
      for (const auto& section : body.sections) n_plain += section.plain && section.segment == segment.name;
      const bool is_long = segment.end_m - segment.begin_m >= segment.diameter_m;
      EXPECT_EQ(n_plain > 0, is_long) << segment.name;
      if (segment.name == "eccentric_seat") {
        EXPECT_EQ(n_plain, 1);
      }
    }
  }
}

/// Deflection and slope of a seat are told at its centre.
TEST(SectionPlanes, IncludeTheCentreOfEachSeat) {
  std::mt19937 random(20261127);
  std::vector<meshes::Shaft> shafts = {laboratory_shaft(), three_steps(), planetary_drum(), two_eccentrics()};
  for (int i = 0; i < 20; ++i) shafts.push_back(random_shaft(random));
  for (const int n_sectors : {8, 16})
    for (const auto& shaft : shafts) {
      meshes::ShaftMeshControl control;
      control.n_sectors = n_sectors;
      control.subdivisions = n_sectors == 8 ? 2 : 1;
      const auto body = meshes::describe_shaft(shaft, control);
      for (const auto& port : body.ports) {
        if (port.kind != meshes::Port::Kind::seat) continue;
        const double centre_m = 0.5 * (port.begin_m + port.end_m), tiny_m = 1e-9 * port.radius_m;
        EXPECT_TRUE(std::any_of(body.sections.begin(), body.sections.end(),
                                [&](const auto& plane) { return std::abs(plane.z_m - centre_m) < tiny_m; }))
            << port.name << " at " << centre_m;
      }
    }
}

/// Two segments of one diameter meet without a shoulder: the plane between them is an ordinary section,
/// counted once.
TEST(SectionPlanes, CrossAJointWithoutAShoulder) {
  meshes::Shaft shaft;
  shaft.segments = {{"free", 0, 0.1, 0.05, 0, false}, {"seat", 0.1, 0.2, 0.05, 0, true}};
  shaft.fillets_m = {0};
  expect_full_discs(shaft, "sections_flush");
  const auto body = meshes::build_shaft(shaft, {});
  int n_at_joint = 0;
  for (const auto& section : body.sections) n_at_joint += std::abs(section.z_m - 0.1) < 1e-12;
  EXPECT_EQ(n_at_joint, 1);
}

}  // namespace
