#include "tests/verification/chambers/chamber_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "pipelines/base/common/stage_clock.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/pipelines/examples/edited_scene.h"

namespace chambers {
namespace {

std::string without(std::string text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from);
  return text.erase(begin, text.find(to, begin) - begin);
}

/// The shipped scene with its chamber alone, whose masses the mesh tells.
std::string chamber_text() {
  std::string text =
      results_test::bytes(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
  text = without(text, "\n[shaft]\n", "\n[chamber]\n");
  text = without(text, "[machine.structure]", "[machine.debalance]");
  text = without(text, "[[chamber.added_masses]]", "[chamber.pressure.inner_wall]");
  const std::vector<std::pair<std::string, std::string>> edits{
      {"  \"gravity_shaft\", \"shaft_inertia\",", "  #"},
      {"  \"pitch\", ", "  # "},
      {"  \"charge_follows_pitch\",", "  #"},
      {"  \"charge_lag\",", "  #"},
      {"instants_per_turn = 120", "instants_per_turn = 36"}};
  for (const auto& [from, to] : edits) text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace

pipelines::Scene scene_around(const meshes::Chamber& chamber, const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "scene.toml", std::ios::binary) << chamber_text();
  auto scene = pipelines::read_scene(directory / "scene.toml");
  auto& body = scene.bodies.at(0);
  std::get<pipelines::ChamberShape>(body.shape).geometry = chamber;
  auto& mill = std::get<kinetics::VibratoryMill>(scene.machine);
  const double r_m = chamber.tube.inner_radius_m;
  mill.eccentricity_m = 0.03 * r_m;
  mill.charge_offset_m = 0.23 * r_m;
  mill.charge_mass_kg = 1300 * 3.14 * r_m * r_m * chamber.tube.length_m;
  mill.chamber_centre_m = {chamber.tube.axis_x_m, chamber.tube.axis_y_m};
  const auto spring = mill.springs.front();
  mill.springs.clear();
  for (const auto& foot : chamber.feet) {
    mill.springs.push_back(spring);
    mill.springs.back().position_m = {foot.x_m, foot.y_m};
    mill.springs.back().preload_N =
        Eigen::Vector2d(0, 2 * mill.charge_mass_kg * mill.gravity_m_s2 / double(chamber.feet.size()));
  }
  return scene;
}

meshes::Chamber small_chamber() {
  const double mm = 1e-3;
  meshes::Chamber chamber;
  chamber.tube = {90 * mm, 9 * mm, 180 * mm, 190 * mm, 30 * mm};
  chamber.flanges = {120 * mm, 12 * mm};
  chamber.housing = {50 * mm, 35 * mm, 70 * mm};
  chamber.webs = {14 * mm, 90 * mm, {0}};
  chamber.lugs = {12 * mm, 36 * mm, 55 * mm};
  chamber.pads = {40 * mm, 30 * mm, 24 * mm};
  chamber.feet = {{80 * mm, -120 * mm}, {300 * mm, -120 * mm}};
  return chamber;
}

meshes::Chamber small_random_chamber(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  while (true) {
    auto chamber = random_chamber(random);
    if (chamber.feet.size() != 2 || chamber.webs.z_m.size() > 2) continue;
    chamber.tube.wall_m = chamber.tube.inner_radius_m * between(0.06, 0.15);
    chamber.tube.length_m = chamber.tube.inner_radius_m * between(1.5, 2.5);
    chamber.lugs.width_m = std::max(chamber.lugs.width_m, 3.2 * chamber.tube.wall_m);
    chamber.lugs.thickness_m = chamber.tube.wall_m * between(0.7, 1.5);
    chamber.pads.size_z_m = chamber.lugs.thickness_m * between(1.5, 3);
    chamber.webs.thickness_m = chamber.tube.wall_m * between(0.8, 2);
    return chamber;
  }
}

pipelines::SceneRun run(const pipelines::Scene& scene, const pipelines::RequestedAccuracy& accuracy) {
  pipelines::SceneRunOptions options;
  options.n_threads = 1;
  options.fresh = true;
  options.cache = false;
  options.accuracy = accuracy;
  pipelines::StageClock clock;
  return pipelines::run_scene(scene, options, clock);
}

}  // namespace chambers
