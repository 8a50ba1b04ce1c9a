/// The shipped scene against the inputs of the reference for the laboratory mill, and what a scene may leave
/// out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "pipelines/scene/machines/vibratory_mill_reader.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/unit/pipelines/examples/edited_scene.h"

namespace {

namespace fs = std::filesystem;
using edited::has_default;
using pipelines::Scene;

const fs::path default_scene = fs::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml";

/// Conversions multiply by one factor that is exact to the last digit.
void expect_same(double value, double expected) {
  EXPECT_NEAR(value, expected, 1e-14 * std::abs(expected));
}

/// A scene of this process alone, under its name in a folder of its own: tests run side by side.
fs::path own_file(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("scenes_" + std::to_string(getpid()));
  fs::create_directories(folder);
  return folder / name;
}

/// The default scene without the lines that hold one of the words, read from a file of its own.
Scene read_without(const std::vector<std::string>& words) {
  const fs::path file = own_file("scene_without.toml");
  std::ifstream in(default_scene);
  std::ofstream out(file);
  for (std::string line; std::getline(in, line);)
    if (std::none_of(words.begin(), words.end(), [&](const auto& w) { return line.rfind(w, 0) == 0; }))
      out << line << '\n';
  out.close();
  Scene scene = pipelines::read_scene(file);
  fs::remove_all(file.parent_path());
  return scene;
}

TEST(default_scene, HasTheLaboratoryMill) {
  const auto mill = pipelines::read_scene(default_scene).vibratory_mill();
  EXPECT_EQ(mill.convention, kinetics::Convention::consistent);
  expect_same(mill.gravity_m_s2, 9.81);
  expect_same(mill.eccentricity_m, 0.004);
  expect_same(mill.speed_rad_s, 151.844);
  EXPECT_EQ(mill.initial_angle_rad, 0);
  expect_same(mill.charge_relative_speed_rad_s, -159.4362);
  expect_same(mill.charge_initial_angle_rad, 1.57);
  expect_same(mill.charge_offset_m, 0.03);
  expect_same(mill.charge_mass_kg, 20);
  expect_same(mill.structure_mass_kg, 30);
  expect_same(mill.exciter_mass_kg, 6);
  expect_same(mill.debalance_mass_kg, 4);
  expect_same(mill.debalance_offset_m, 0.01);
  expect_same(mill.chamber_centre_m.x(), 0.28);
  expect_same(mill.chamber_centre_m.y(), 0.04);
  expect_same(mill.structure_centre_m.x(), 0.26);
  expect_same(mill.structure_centre_m.y(), 0.02);
  expect_same(mill.pitch_inertia_kg_m2, 2.85);
  EXPECT_EQ(mill.charge_lag.grinding_power_W, 500);
  EXPECT_FALSE(mill.charge_lag.loss_angle_rad);
  ASSERT_EQ(mill.springs.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const auto& spring = mill.springs[static_cast<std::size_t>(i)];
    expect_same(spring.position_m.x(), i == 0 ? 0.1 : 0.46);
    expect_same(spring.position_m.y(), -0.18);
    expect_same(spring.stiffness_N_m.x(), 14000);
    expect_same(spring.stiffness_N_m.y(), 27500);
    expect_same(spring.damping_N_s_m.x(), 30);
    expect_same(spring.damping_N_s_m.y(), 60);
    EXPECT_FALSE(spring.preload_N);
  }
}

TEST(default_scene, HasEveryEffectOfTheConventionAndTheShaftsOwn) {
  const Scene scene = pipelines::read_scene(default_scene);
  for (const auto& effect : kinetics::vibratory_mill_effects(kinetics::Convention::consistent))
    EXPECT_TRUE(scene.has_effect(effect.name)) << effect.name;
  EXPECT_TRUE(scene.has_effect("gravity_shaft"));
  EXPECT_TRUE(scene.has_effect("shaft_inertia"));
  EXPECT_FALSE(scene.has_effect("magnetism"));
  EXPECT_EQ(scene.kinetics_effects().size(), scene.effects.size() - 2);
  EXPECT_NO_THROW(pipelines::compute_loads(scene.machine, scene.kinetics_effects(), {1, 24}));
}

TEST(default_scene, HasTheLaboratoryShaft) {
  const Scene scene = pipelines::read_scene(default_scene);
  const auto* body = scene.body("shaft");
  ASSERT_TRUE(body && body->shaft());
  EXPECT_TRUE(std::holds_alternative<pipelines::VibratoryShaftOptions>(body->options));
  const auto& [segments, fillets_m] = body->shaft()->geometry;
  struct Expected {
    const char* name;
    double begin_mm, end_mm, diameter_mm, eccentricity_mm;
    bool is_port;
  };
  const Expected expected[] = {
      {"coupling", -272.5, -227.5, 25, 0, true},       {"debalance_1", -227.5, -191.5, 30, 0, true},
      {"main_bearing_1", -191.5, -168.5, 35, 0, true}, {"body_1", -168.5, -30, 42, 0, false},
      {"eccentric_seat", -30, 30, 60, 4, true},        {"body_2", 30, 168.5, 42, 0, false},
      {"main_bearing_2", 168.5, 191.5, 35, 0, true},   {"debalance_2", 191.5, 227.5, 30, 0, true},
  };
  ASSERT_EQ(segments.size(), std::size(expected));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_EQ(segments[i].name, expected[i].name);
    EXPECT_EQ(segments[i].is_port, expected[i].is_port);
    EXPECT_NEAR(segments[i].begin_m, expected[i].begin_mm / 1e3,
                1e-15);  // sums of lengths: rounding of 0.3 m
    EXPECT_NEAR(segments[i].end_m, expected[i].end_mm / 1e3, 1e-15);
    expect_same(segments[i].diameter_m, expected[i].diameter_mm / 1e3);
    expect_same(segments[i].eccentricity_m, expected[i].eccentricity_mm / 1e3);
    EXPECT_EQ(segments[i].begin_m, i > 0 ? segments[i - 1].end_m : segments[0].begin_m) << "no gap at all";
  }
  const double expected_fillets_mm[] = {1, 1, 1, 2.5, 2.5, 1, 1};
  ASSERT_EQ(fillets_m.size(), std::size(expected_fillets_mm));
  for (std::size_t i = 0; i < fillets_m.size(); ++i) expect_same(fillets_m[i], expected_fillets_mm[i] / 1e3);

  EXPECT_EQ(body->material_name, "C45+N");
  expect_same(body->material.youngs_modulus_Pa, 206e9);
  expect_same(body->material.poisson_ratio, 0.3);
  expect_same(body->material.density_kg_m3, 7850);
  expect_same(body->yield_strength_Pa, 305e6);
  EXPECT_EQ(body->pressure_harmonics, 4);
  EXPECT_EQ(std::get<pipelines::VibratoryShaftOptions>(body->options).debalance_shares,
            (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(body->shaft()->mesh.cells_per_fillet_quarter, 8);
  EXPECT_EQ(body->shaft()->mesh.n_sectors, 16);
  EXPECT_EQ(body->shaft()->mesh.largest_cell_m, 0);
}

TEST(default_scene, CoversThePeriodAndWarnsOfNothing) {
  const Scene scene = pipelines::read_scene(default_scene);
  EXPECT_EQ(scene.title, "Laboratory vibratory mill");
  EXPECT_EQ(scene.file, default_scene);
  EXPECT_EQ(scene.sampling.turns, 20);
  EXPECT_EQ(scene.sampling.instants_per_turn, 120);
  EXPECT_EQ(scene.zones.reference, pipelines::ZoneRule::Reference::peak);
  EXPECT_EQ(scene.zones.share, 0.5);
  EXPECT_EQ(scene.snapshots, 12);
  ASSERT_TRUE(scene.milling_space);
  expect_same(scene.milling_space->inner_radius_m, 0.13);
  EXPECT_EQ(scene.warnings.size(), 0u);
  EXPECT_TRUE(has_default(scene, "shaft.contour[9].eccentricity", "0.004 m"));
  EXPECT_TRUE(has_default(scene, "machine.springs.preload", "static balance"));
}

TEST(scene, RecordsTheDefaultsThatItTakes) {
  const Scene scene =
      read_without({"title", "convention", "gravity ", "initial_angle", "turns", "instants_per_turn", "level",
                    "snapshots", "[zones]", "sectors", "debalance_shares"});
  EXPECT_TRUE(has_default(scene, "title", "\"scene_without\""));
  EXPECT_TRUE(has_default(scene, "machine.convention", "\"consistent\""));
  EXPECT_TRUE(has_default(scene, "machine.gravity", "9.81 m/s2"));
  EXPECT_TRUE(has_default(scene, "machine.drive.initial_angle", "0 rad"));
  EXPECT_TRUE(has_default(scene, "sampling.turns", "20")) << "the period, from the turn ratio";
  EXPECT_TRUE(has_default(scene, "sampling.instants_per_turn", "120"));
  EXPECT_TRUE(has_default(scene, "zones.level", "\"50 % of peak\""));
  EXPECT_TRUE(has_default(scene, "results.snapshots", "12"));
  EXPECT_TRUE(has_default(scene, "shaft.mesh.sectors", "16"));
  EXPECT_EQ(scene.sampling.turns, 20);
  EXPECT_EQ(scene.vibratory_mill().charge_initial_angle_rad, 0);
}

TEST(scene, OfThePaperToTheLetterIsForTheLoadStage) {
  std::ifstream in(default_scene);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  text = text.substr(text.find("[machine]"));
  text = text.substr(0, text.find("\n[shaft]"));
  text.replace(text.find("\"consistent\""), 12, "\"published\"");
  const fs::path file = own_file("published.toml");
  std::ofstream(file) << "effects = [\"gravity_structure\", \"charge_coriolis\", \"springs\"]\n" << text;
  const Scene scene = pipelines::read_scene(file);
  fs::remove_all(file.parent_path());
  EXPECT_EQ(scene.vibratory_mill().convention, kinetics::Convention::published);
  EXPECT_TRUE(scene.bodies.empty());
  EXPECT_FALSE(has_default(scene, "machine.springs.preload", "static balance")) << "the paper has no preload";
}

TEST(scene, WarnsOfACornerWithoutFillet) {
  const Scene scene = read_without({"  { fillet = \"2.5"});
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[0].find("between \"body_1\" and \"eccentric_seat\" has no fillet"),
            std::string::npos);
  EXPECT_EQ(scene.body("shaft")->shaft()->geometry.fillets_m[3], 0);
  EXPECT_GT(scene.body("shaft")->shaft()->geometry.fillets_m[2], 0) << "the others stay where they were";
}

TEST(largest_filling, FitsFullHalfAndEmptyChambers) {
  EXPECT_NEAR(pipelines::largest_filling(0, 0.13), 1, 1e-12);
  EXPECT_NEAR(pipelines::largest_filling(0.13, 0.13), 0, 1e-9);
  const double half_disc_centroid = 4 / (3 * 3.14159265358979323846);
  EXPECT_NEAR(pipelines::largest_filling(half_disc_centroid, 1), 0.5, 1e-12);
  EXPECT_NEAR(pipelines::largest_filling(0.03, 0.13), 0.73, 0.005);  // coupling specification, 7.2: 73 %
}

}  // namespace
