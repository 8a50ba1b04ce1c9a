/// Drum, stub axle, train shaft and table body of a scene: values in SI, defaults, masses left to the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tests/unit/pipelines/examples/edited_scene.h"

namespace {

using edited::has_default;
using pipelines::Scene;

void expect_same_size(double value, double expected) {
  EXPECT_NEAR(value, expected, 1e-14 * std::abs(expected));
}

const meshes::ShaftSegment& segment(const pipelines::BodyScene& body, std::string_view name) {
  for (const auto& s : body.shaft()->geometry.segments)
    if (s.name == name) return s;
  throw std::out_of_range(std::string(name));
}

TEST(SceneDrum, HasSetB) {
  const Scene scene = edited::scene("planetary_mill", {});
  ASSERT_EQ(scene.bodies.size(), 1u);
  const auto& body = *scene.body("drum");
  EXPECT_TRUE(std::holds_alternative<pipelines::DrumOptions>(body.options));
  ASSERT_TRUE(body.shaft());
  // coupling.md 7.3; z = 0 in the middle of the inner wall, bearings at +-560, pulley at 629.
  struct Expected {
    const char* name;
    double begin_mm, end_mm, diameter_mm, bore_mm;
    bool is_port;
  };
  for (const auto& e : {Expected{"trunnion_1", -580, -540, 80, 40, true},
                        {"root_1", -540, -520, 95, 40, false},
                        {"cover_1", -520, -500, 216, 40, false},
                        {"shell", -500, 500, 216, 200, false},
                        {"root_2", 520, 540, 95, 40, false},
                        {"trunnion_2", 540, 580, 80, 40, true},
                        {"pulley_seat", 580, 678, 70, 40, true}}) {
    const auto& s = segment(body, e.name);
    EXPECT_NEAR(s.begin_m, e.begin_mm / 1e3, 1e-15) << e.name;  // sums of lengths: rounding of 1 m
    EXPECT_NEAR(s.end_m, e.end_mm / 1e3, 1e-15) << e.name;
    expect_same_size(s.diameter_m, e.diameter_mm / 1e3);
    expect_same_size(s.bore_m, e.bore_mm / 1e3);
    EXPECT_EQ(s.is_port, e.is_port) << e.name;
  }
  EXPECT_EQ(segment(body, "shell").bore_port, "inner_wall");
  EXPECT_EQ(body.shaft()->geometry.fillets_m, (std::vector<double>{0.003, 0.01, 0, 0, 0.01, 0.003, 0.003}));
  EXPECT_EQ(body.difference_port, "pulley_seat");
  ASSERT_EQ(body.added_masses.size(), 1u);
  expect_same_size(body.added_masses[0].mass_kg, 21.1);
  EXPECT_EQ(body.added_masses[0].region, "");
  EXPECT_EQ(body.shaft()->mesh.n_sectors, 24);
  EXPECT_TRUE(has_default(scene, "drum.pressure_harmonics", "4"));
  EXPECT_TRUE(scene.masses_from_mesh.empty());
  EXPECT_TRUE(scene.has_effect("drum_spin"));
  const auto of_kinetics = scene.kinetics_effects();
  EXPECT_EQ(std::count(of_kinetics.begin(), of_kinetics.end(), "drum_spin"), 0);
}

TEST(SceneDrum, LeavesItsMassToTheMesh) {
  const Scene scene = edited::scene(
      "planetary_mill", {{"mass = \"79.47 kg\"        # shell, covers, trunnions and pulley\n", ""}});
  EXPECT_EQ(scene.masses_from_mesh, std::vector<std::string>{"drum"});
  EXPECT_TRUE(has_default(scene, "machine.drum.mass", "from the mesh"));
}

TEST(SceneDrum, BeltWrapsThePulleysSeat) {
  const Scene scene = edited::scene(
      "planetary_mill", {{"[[drum.added_masses]]",
                          "[drum.pressure.pulley_seat]\npattern = \"uniform\"\nhalf_angle = \"80 deg\"\n"
                          "harmonics = 9\n\n[[drum.added_masses]]"}});
  const auto& seat = scene.body("drum")->pressures.at("pulley_seat");
  EXPECT_EQ(seat.pattern.kind, pipelines::PressurePattern::Kind::uniform);
  expect_same_size(seat.pattern.half_angle_rad, 80 * M_PI / 180);
  EXPECT_EQ(seat.highest_harmonic, 9);
}

TEST(SceneAxle, HasTheStub) {
  const Scene scene = edited::scene("stub_axle", {});
  const auto& body = *scene.body("axle");
  const auto& axle = std::get<pipelines::StubAxleOptions>(body.options);
  expect_same_size(axle.bearing_span_m, 1.12);
  expect_same_size(axle.pulley_plane_m, 0.629);
  expect_same_size(axle.pulley_mass_kg, 21.1);
  EXPECT_FALSE(axle.pulley_side) << "the plain side carries more";
  EXPECT_EQ(body.shaft()->geometry.segments.front().begin_m, 0) << "from the clamped end";
  expect_same_size(segment(body, "bearing").end_m, 0.13);
  EXPECT_TRUE(has_default(scene, "axle.begin", "0 m"));
  EXPECT_TRUE(body.added_masses.empty());
  const auto of_kinetics = scene.kinetics_effects();
  EXPECT_EQ(of_kinetics.size(), scene.effects.size() - 2) << "axle_gravity and axle_transport are its own";
  const Scene other = edited::scene(
      "stub_axle", {{"side = \"plain\" ", "side = \"pulley\" "}, {"pulley_mass = \"21.1 kg\" ", "# "}});
  EXPECT_TRUE(std::get<pipelines::StubAxleOptions>(other.body("axle")->options).pulley_side);
  EXPECT_TRUE(has_default(other, "axle.pulley_mass", "0 kg"));
  const Scene silent = edited::scene("stub_axle", {{"side = \"plain\" ", "# "}});
  EXPECT_TRUE(has_default(silent, "axle.side", "\"plain\""));
}

// 500 W at a fifth of the speed would need a sine of 5 x 25. Red if what is off is refused for its value.
TEST(SceneVibratoryMill, TakesAPowerBeyondTheLagThatIsOff) {
  const edited::Edits slow{{"speed = \"151.844 rad/s\"", "speed = \"30 rad/s\""}};
  EXPECT_THROW(edited::scene("vibratory_mill", slow), pipelines::SceneError);
  auto off = slow;
  off.emplace_back("  \"charge_lag\", ", "  #");
  EXPECT_EQ(edited::scene("vibratory_mill", off).vibratory_mill().charge_lag.grinding_power_W, 500);
}

TEST(SceneTrainShaft, HasThePeelers) {
  const Scene scene = edited::scene("root_peeler_shaft", {});
  const auto& body = *scene.body("shaft");
  const auto& train = std::get<pipelines::TrainShaftOptions>(body.options);
  EXPECT_EQ(train.inertia, "working_shaft");
  ASSERT_EQ(train.torques.size(), 2u);
  EXPECT_EQ(train.torques[0].port, "pulley_seat");
  EXPECT_EQ(train.torques[0].role, "working_shaft_1_on_working_shaft");
  EXPECT_EQ(train.torques[1].port, "disc_seat");
  EXPECT_EQ(train.torques[1].role, "working_shaft_2_on_working_shaft");
  EXPECT_EQ(train.bearings, (std::array<std::string, 2>{"bearing_1", "bearing_2"}));
  EXPECT_EQ(train.axial_bearing, "bearing_1");
  ASSERT_EQ(train.forces.size(), 3u);
  EXPECT_EQ(train.forces[0].effect, "belt_pull");
  EXPECT_EQ(train.forces[0].force_N, (std::array<double, 3>{240, 0, 0}));
  EXPECT_FALSE(train.forces[0].turns_with_shaft);
  EXPECT_TRUE(train.forces[1].turns_with_shaft);
  EXPECT_EQ(train.forces[2].force_N, (std::array<double, 3>{0, 0, -118}));
  EXPECT_TRUE(has_default(scene, "shaft.forces[1].turns_with_shaft", "false"));
  EXPECT_EQ(scene.masses_from_mesh, std::vector<std::string>{"working_shaft"});
  expect_same_size(segment(body, "disc_seat").end_m, 0.184);
  // Its own effects and its forces are no business of the train.
  EXPECT_EQ(scene.kinetics_effects(), (std::vector<std::string>{"motor_torque", "peeling_torque"}));
}

// The working shaft makes 3/8 of the motor's turn. Red if one turn of the motor is the period, in which a
// belt's pull goes round 3/8 of the shaft: bending that reverses was stated as a seventh of its amplitude.
TEST(SceneTrainShaft, GoesRoundToForcesThatStandStillInSpace) {
  const std::pair<std::string, std::string> no_turns{"turns = 272  #", "#"};
  const auto warning = [](const Scene& scene) { return scene.warnings.empty() ? "" : scene.warnings[0]; };
  EXPECT_EQ(edited::scene("root_peeler_shaft", {no_turns}).sampling.turns, 8);
  EXPECT_EQ(warning(edited::scene("root_peeler_shaft", {})), "") << "272 turns are 34 periods";
  EXPECT_EQ(
      warning(edited::scene("root_peeler_shaft", {{"turns = 272", "turns = 12"}})),
      "sampling.turns = 12: the motion repeats after 8 turns; extremes and means are those of the turns "
      "given");
  EXPECT_EQ(edited::scene("root_peeler_shaft", {no_turns, {"ratio = 0.375", "ratio = -0.02"}}).sampling.turns,
            50);
  EXPECT_THROW(edited::scene("root_peeler_shaft", {no_turns, {"ratio = 0.375", "ratio = 0.37512345"}}),
               pipelines::SceneError)
      << "no period: turns are required";
  // What turns with the shaft, acts along it or is off has no period.
  EXPECT_EQ(edited::scene("root_peeler_shaft", {no_turns, {"\"belt_pull\", ", ""}}).sampling.turns, 1);
}

TEST(SceneTrainShaft, NeedsNoForces) {
  const Scene scene = edited::scene(
      "root_peeler_shaft",
      {{"  \"belt_pull\", \"disc_imbalance\", \"disc_weight\",\n", ""},
       {"axial_bearing = \"bearing_1\"\n", ""},
       {"[[shaft.forces]]      # across [x, y] and along [z]; the shaft stands upright, so weights act "
        "along it\neffect = \"belt_pull\"\nport = \"pulley_seat\"\nforce = [\"240 N\", \"0 N\", \"0 N\"]\n",
        ""},
       {"[[shaft.forces]]\neffect = \"disc_imbalance\"\nport = \"disc_seat\"\n"
        "force = [\"860 N\", \"0 N\", \"0 N\"]  # 3 kg of roots 0.1 m off the axis at 510 rpm\n"
        "turns_with_shaft = true\n",
        ""},
       {"[[shaft.forces]]\neffect = \"disc_weight\"\nport = \"disc_seat\"\n"
        "force = [\"0 N\", \"0 N\", \"-118 N\"]\n",
        ""}});
  EXPECT_TRUE(std::get<pipelines::TrainShaftOptions>(scene.body("shaft")->options).forces.empty());
  EXPECT_TRUE(has_default(scene, "shaft.axial_bearing", "\"bearing_1\""));
}

TEST(SceneTrainShaft, WarnsOfAPortThatAFilletShortensByMoreThanHalf) {
  const auto with_fillet = [](const std::string& size) {
    return edited::scene("root_peeler_shaft",
                         {{"length = \"15 mm\" },\n  { fillet = \"1 mm\" },\n  { name",
                           "length = \"15 mm\" },\n  { fillet = \"" + size + "\" },\n  { name"},
                          {"diameter = \"30 mm\"", "diameter = \"40 mm\""}});
  };
  EXPECT_TRUE(with_fillet("3.7 mm").warnings.empty());
  const auto warnings = with_fillet("3.8 mm").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("\"bearing_1\" is loaded over 7.4 mm of its 15 mm"), std::string::npos)
      << warnings[0];
}

// A ring's groove drawn with sharp corners: 54.7 MPa +- 0.2 at a fillet elsewhere, 94.0 MPa in it with
// fillets of 0.1 mm.
TEST(SceneTrainShaft, WarnsOfAGrooveThatIsLeftOutBetweenSharpCorners) {
  const auto of_groove = [](const std::string& length, const std::string& fillet = "") {
    const auto scene = edited::scene(
        "root_peeler_shaft", {{"{ fillet = \"1 mm\" },\n  { name",
                               "{ fillet = \"1 mm\" },\n  { name = \"left\", diameter = \"30 mm\", length = "
                               "\"10 mm\" },\n" +
                                   fillet + "  { name = \"groove\", diameter = \"28 mm\", length = \"" +
                                   length + "\" },\n" + fillet + "  { name"}});
    return std::count_if(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
      return warning.find("the surface of \"groove\" is judged nowhere") != std::string::npos;
    });
  };
  EXPECT_EQ(of_groove("5.5 mm"), 1);
  EXPECT_EQ(of_groove("5.7 mm"), 0) << "2.8 mm are left out at each corner";
  EXPECT_EQ(of_groove("5.5 mm", "  { fillet = \"0.2 mm\" },\n"), 0);
}

TEST(SceneTrainShaft, WarnsOfTheRootOfAKeyway) {
  const std::string bearings = "bearings = [\"bearing_1\", \"bearing_2\"]",
                    keyway =
                        "\nkeyways = [{ segment = \"pulley_seat\", width = \"8 mm\", depth = \"4 mm\", "
                        "length = \"20 mm\", begin = \"10 mm\" }]";
  const auto with_keyway = edited::scene(
      "root_peeler_shaft",
      {{bearings, bearings + keyway}, {"cells_per_fillet_quarter = 4", "cells_per_circle = 12"}});
  ASSERT_EQ(with_keyway.warnings.size(), 1u);
  EXPECT_NE(with_keyway.warnings[0].find("has sharp edges at its root"), std::string::npos)
      << with_keyway.warnings[0];
}

const char* part_table = R"(
[part]
contour = [
  { port = "bearing_1", diameter = "25 mm", length = "15 mm", bore = "10 mm" },
  { fillet = "1 mm" },
  { port = "pulley_seat", diameter = "30 mm", length = "64 mm", bore = "10 mm", bore_port = "inside" },
  { fillet = "1 mm" },
  { port = "disc_seat", diameter = "26 mm", length = "15 mm", bore = "10 mm" },
  { port = "bearing_2", diameter = "25 mm", length = "15 mm", bore = "10 mm" },
]
begin = "-20 mm"
bearings = ["bearing_1", "bearing_2"]
axial_support = "end_1"
torque_support = "bearing_2"
[part.material]
name = "C45+N"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
[part.mesh]
largest_cell = "5 mm"
)";

TEST(ScenePart, TakesAnyPortAndItsSupports) {
  const Scene scene = edited::scene(
      "load_table", {{"turns = 1  # the period of the samples", "turns = 1\n" + std::string(part_table)}});
  const auto& body = *scene.body("part");
  const auto& table = std::get<pipelines::TableBodyOptions>(body.options);
  EXPECT_EQ(table.bearings, (std::vector<std::string>{"bearing_1", "bearing_2"}));
  EXPECT_EQ(table.axial_support, "end_1");
  EXPECT_EQ(table.torque_support, "bearing_2");
  expect_same_size(body.shaft()->geometry.segments.front().begin_m, -0.02);
  EXPECT_EQ(segment(body, "pulley_seat").bore_port, "inside");
  expect_same_size(body.shaft()->mesh.largest_cell_m, 0.005);
  EXPECT_EQ(body.difference_port, "") << "a table has no masses of its own";
}

TEST(ScenePart, IsHeldByAClamp) {
  const std::string supports =
      "bearings = [\"bearing_1\", \"bearing_2\"]\naxial_support = \"end_1\"\ntorque_support = "
      "\"bearing_2\"\n";
  std::string held = part_table;
  held.replace(held.find(supports), supports.size(), "clamp = \"end_1\"\n");
  const Scene scene = edited::scene(
      "load_table", {{"turns = 1  # the period of the samples", "turns = 1\n" + std::string(held)}});
  const auto& options = std::get<pipelines::TableBodyOptions>(scene.body("part")->options);
  EXPECT_EQ(options.clamp, "end_1");
  EXPECT_TRUE(options.bearings.empty());
  EXPECT_EQ(options.axial_support + options.torque_support, "");
}

}  // namespace
