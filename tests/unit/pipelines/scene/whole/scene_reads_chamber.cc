/// The chamber of a scene: sizes in SI, what comes from the machine, what may be left out.
#include <gtest/gtest.h>

#include <cmath>

#include "meshes/chamber/chamber_checks.h"
#include "tests/unit/pipelines/examples/edited_scene.h"

namespace {

using edited::has_default;

/// Conversions multiply by one factor that is exact to the last digit.
void expect_same_number(double value, double expected) {
  EXPECT_NEAR(value, expected, 1e-14 * std::abs(expected));
}

TEST(SceneChamber, HasTheLaboratorySizes) {
  const auto scene = edited::scene("vibratory_mill", {});
  ASSERT_EQ(scene.bodies.size(), 2u);
  const auto* body = scene.body("chamber");
  ASSERT_TRUE(body);
  ASSERT_TRUE(std::holds_alternative<pipelines::ChamberOptions>(body->options));
  EXPECT_EQ(body->shaft(), nullptr);
  const auto& [g, mesh] = std::get<pipelines::ChamberShape>(body->shape);
  expect_same_number(g.tube.inner_radius_m, 0.13);
  expect_same_number(g.tube.length_m, 0.21);
  expect_same_number(g.tube.wall_m, 0.012);
  expect_same_number(g.tube.axis_x_m, 0.28);
  expect_same_number(g.tube.axis_y_m, 0.04);
  expect_same_number(g.flanges.outer_radius_m, 0.186);
  expect_same_number(g.flanges.thickness_m, 0.008);
  expect_same_number(g.housing.outer_radius_m, 0.065);
  expect_same_number(g.housing.bore_radius_m, 0.0475);
  expect_same_number(g.housing.length_m, 0.105);
  expect_same_number(g.webs.thickness_m, 0.015);
  expect_same_number(g.webs.height_m, 0.17);
  ASSERT_EQ(g.webs.z_m.size(), 2u);
  expect_same_number(g.webs.z_m[0], -0.045);
  expect_same_number(g.webs.z_m[1], 0.045);
  expect_same_number(g.lugs.thickness_m, 0.008);
  expect_same_number(g.lugs.width_m, 0.05);
  expect_same_number(g.lugs.z_m, 0.075);
  expect_same_number(g.pads.size_x_m, 0.05);
  expect_same_number(g.pads.size_y_m, 0.02);
  expect_same_number(g.pads.size_z_m, 0.03);
  ASSERT_EQ(g.feet.size(), 2u);
  expect_same_number(g.feet[0].x_m, 0.1);
  expect_same_number(g.feet[1].x_m, 0.46);
  for (const auto& foot : g.feet) expect_same_number(foot.y_m, -0.18);
  EXPECT_EQ(mesh.cells_through_wall, 2);
  EXPECT_EQ(mesh.size_m, 0);

  EXPECT_EQ(body->material_name, "S235");
  expect_same_number(body->yield_strength_Pa, 225e6);
  EXPECT_EQ(body->difference_port, "covers");
  EXPECT_EQ(std::get<pipelines::ChamberOptions>(body->options).pitch_guide, pipelines::PitchGuide::body);
  EXPECT_FALSE(std::get<pipelines::ChamberOptions>(body->options).elastic_feet);
  const auto& wall = body->pressures.at("inner_wall");
  EXPECT_EQ(wall.pattern.kind, pipelines::PressurePattern::Kind::cosine);
  expect_same_number(wall.pattern.half_angle_rad, M_PI / 2);
  EXPECT_EQ(wall.highest_harmonic, 4);
  EXPECT_EQ(wall.axial_profile, std::vector<double>{1});
  ASSERT_EQ(body->added_masses.size(), 2u);
  const auto &covers = body->added_masses[0], &rings = body->added_masses[1];
  EXPECT_EQ(covers.port, "covers");
  EXPECT_EQ(covers.region, "structure");
  expect_same_number(covers.mass_kg, 2);
  expect_same_number(covers.polar_inertia_kg_m2, 0.0296);
  EXPECT_EQ(rings.port, "housing_bore");
  EXPECT_EQ(rings.region, "exciter") << "it rides on the bore";
  EXPECT_TRUE(scene.masses_from_mesh.empty());
}

// Scene and mesher have one limit: what the mesher takes may be asked for, and nothing beyond it.
TEST(SceneChamber, MeshLimitsAreThoseOfTheMesher) {
  const int most = meshes::ChamberMeshControl::most_cells_through_wall;
  const double steepest = meshes::ChamberMeshControl::steepest_growth;
  const auto with = [](int cells, double growth) {
    return edited::scene("vibratory_mill",
                         {{"cells_through_wall = 2\n", "cells_through_wall = " + std::to_string(cells) +
                                                           "\ngrowth = " + std::to_string(growth) + "\n"}});
  };
  const auto scene = with(most, steepest);
  const auto& mesh = std::get<pipelines::ChamberShape>(scene.body("chamber")->shape).mesh;
  EXPECT_EQ(mesh.cells_through_wall, most);
  EXPECT_EQ(mesh.growth, steepest);
  EXPECT_NO_THROW(meshes::check_control(mesh));
  EXPECT_ANY_THROW(with(most + 1, steepest));
  EXPECT_ANY_THROW(with(most, 1.01 * steepest));
}

TEST(SceneChamber, RecordsItsDefaults) {
  const auto scene = edited::scene("vibratory_mill", {{"difference_port = \"covers\"\n", ""},
                                                      {"elastic_feet = false ", "# "},
                                                      {"pitch_guide = \"body\" ", "# "},
                                                      {"half_angle = \"90 deg\"\n", ""},
                                                      {"cells_through_wall = 2\n", ""}});
  EXPECT_TRUE(has_default(scene, "chamber.difference_port", "\"covers\""));
  EXPECT_TRUE(has_default(scene, "chamber.elastic_feet", "false"));
  EXPECT_TRUE(has_default(scene, "chamber.pitch_guide", "\"body\""));
  EXPECT_TRUE(has_default(scene, "chamber.tube.inner_radius", "0.13 m"));
  EXPECT_TRUE(has_default(scene, "chamber.tube.length", "0.21 m"));
  EXPECT_TRUE(has_default(scene, "chamber.mesh.cells_through_wall", "2"));
  EXPECT_TRUE(has_default(scene, "chamber.pressure.inner_wall.pattern", "\"cosine\""));
  EXPECT_TRUE(has_default(scene, "chamber.added_masses[2].moves_with", "\"exciter\""));
  EXPECT_NEAR(scene.body("chamber")->pressures.at("inner_wall").pattern.half_angle_rad, M_PI / 2, 1e-15);
}

TEST(SceneChamber, TakesItsOptions) {
  const auto scene = edited::scene(
      "vibratory_mill",
      {{"difference_port = \"covers\"", "difference_port = \"spring_foot_1\""},
       {"pitch_guide = \"body\"", "pitch_guide = \"feet\""},
       {"elastic_feet = false", "elastic_feet = true"},
       {"wall = \"12 mm\"", "wall = \"12 mm\"\ninner_radius = \"131 mm\"\nlength = \"0.3 m\""},
       {"half_angle = \"90 deg\"\nharmonics = 4",
        "half_angle = \"60 deg\"\npattern = \"uniform\"\nharmonics = 7\naxial = [1, 3, 0]"},
       {"mass = \"2 kg\"", "mass = \"2 kg\"\noffset = [\"10 mm\", \"-5 mm\"]\nmoves_with = \"exciter\""},
       {"# size = \"20 mm\"", "size = \"20 mm\""}});
  const auto& body = *scene.body("chamber");
  EXPECT_EQ(body.difference_port, "spring_foot_1");
  EXPECT_EQ(std::get<pipelines::ChamberOptions>(body.options).pitch_guide, pipelines::PitchGuide::feet);
  EXPECT_TRUE(std::get<pipelines::ChamberOptions>(body.options).elastic_feet);
  const auto& shape = std::get<pipelines::ChamberShape>(body.shape);
  expect_same_number(shape.geometry.tube.inner_radius_m, 0.131);
  expect_same_number(shape.geometry.tube.length_m, 0.3);
  expect_same_number(shape.mesh.size_m, 0.02);
  const auto& wall = body.pressures.at("inner_wall");
  EXPECT_EQ(wall.pattern.kind, pipelines::PressurePattern::Kind::uniform);
  expect_same_number(wall.pattern.half_angle_rad, M_PI / 3);
  EXPECT_EQ(wall.highest_harmonic, 7);
  EXPECT_EQ(wall.axial_profile, (std::vector<double>{1, 3, 0}));
  EXPECT_EQ(body.added_masses[0].region, "exciter");
  expect_same_number(body.added_masses[0].centre_m[0], 0.01);
  expect_same_number(body.added_masses[0].centre_m[1], -0.005);
}

// A parabola by straight lines: 1 - s^2 at its points, nothing at the rims.
TEST(SceneChamber, ParabolicPressureIsAProfile) {
  const auto scene = edited::scene("vibratory_mill", {{"half_angle = \"90 deg\"", "axial = \"parabolic\""}});
  const auto& profile = scene.body("chamber")->pressures.at("inner_wall").axial_profile;
  ASSERT_GT(profile.size(), 8u);
  EXPECT_EQ(profile.front(), 0);
  EXPECT_EQ(profile.back(), 0);
  for (std::size_t i = 0; i < profile.size(); ++i)
    EXPECT_NEAR(profile[i], 1 - std::pow(2.0 * double(i) / double(profile.size() - 1) - 1, 2), 1e-15);
}

TEST(SceneChamber, LeavesMassesToTheMesh) {
  const std::string structure =
      "[machine.structure]           # the chamber and what is fixed to it\n"
      "mass = \"30 kg\"\ncentre = [\"260 mm\", \"20 mm\"]\n"
      "pitch_inertia = \"2.85 kg m2\"  # about the eccentric's axis, exciter housing included, charge not\n";
  const std::string exciter =
      "[machine.exciter]             # the housing of the eccentric's bearings\nmass = \"6 kg\"\n";
  auto scene = edited::scene("vibratory_mill", {{structure, ""}, {exciter, ""}});
  EXPECT_EQ(scene.masses_from_mesh, (std::vector<std::string>{"structure", "exciter"}));
  EXPECT_TRUE(has_default(scene, "machine.structure", "from the mesh"));
  EXPECT_TRUE(has_default(scene, "machine.exciter", "from the mesh"));
  scene = edited::scene("vibratory_mill", {{exciter, ""}});
  EXPECT_EQ(scene.masses_from_mesh, std::vector<std::string>{"exciter"});
  expect_same_number(scene.vibratory_mill().structure_mass_kg, 30);
}

// The chamber needs no [machine.chamber] sizes if it has its own.
TEST(SceneChamber, HasItsOwnSizesWhereTheMachineHasNone) {
  const auto scene = edited::scene(
      "vibratory_mill",
      {{"inner_radius = \"130 mm\"       # optional, as is the next: is there room for the charge?\n", ""},
       {"inner_length = \"210 mm\"\n", ""},
       {"wall = \"12 mm\"", "wall = \"12 mm\"\ninner_radius = \"140 mm\"\nlength = \"0.25 m\""}});
  EXPECT_FALSE(scene.milling_space);
  const auto& shape = std::get<pipelines::ChamberShape>(scene.body("chamber")->shape);
  expect_same_number(shape.geometry.tube.inner_radius_m, 0.14);
  expect_same_number(shape.geometry.tube.length_m, 0.25);
}

}  // namespace
