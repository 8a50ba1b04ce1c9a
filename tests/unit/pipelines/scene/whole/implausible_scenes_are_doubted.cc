// Speeds with a wrong unit, from shipped scenes. The accelerations are those of issue and hand: 4 mm at
// 1450 rad/s are 8410 m/s2 = 857 g; at 1450 rpm 92 m/s2 = 9.4 g, which is what such mills run at.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "pipelines/scene/whole/plausibility.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

namespace fs = std::filesystem;
using namespace pipelines;

fs::path shipped_scenes() {
  return fs::path(SOURCE_DIR) / "pipelines/scenes";
}

std::vector<std::string> doubts_of(const std::string& scene, const std::string& old_text = "",
                                   const std::string& new_text = "") {
  const results_test::Directory directory;
  fs::copy(shipped_scenes() / "belt_pull.csv", directory / "belt_pull.csv");
  std::string text = results_test::bytes(shipped_scenes() / scene);
  const auto at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  text.replace(at, old_text.size(), new_text);
  std::ofstream(directory / "scene.toml") << text;
  const auto read = read_scene(directory / "scene.toml");
  auto doubts = implausible(read);
  for (const auto& doubt : doubts)
    EXPECT_EQ(std::count(read.warnings.begin(), read.warnings.end(), doubt), 1) << doubt;
  return doubts;
}

bool one_says(const std::vector<std::string>& doubts, const std::string& fragment) {
  return std::any_of(doubts.begin(), doubts.end(),
                     [&](const auto& doubt) { return doubt.find(fragment) != std::string::npos; });
}

TEST(Plausibility, ShippedScenesAreNotDoubted) {
  for (const char* scene : {"vibratory_mill.toml", "planetary_mill.toml", "stub_axle.toml",
                            "drive_train.toml", "root_peeler_shaft.toml", "load_table.toml"})
    EXPECT_TRUE(doubts_of(scene).empty()) << scene << ": " << doubts_of(scene).front();
}

TEST(Plausibility, ABareSpeedAndHertzInsteadOfRevolutionsAreDoubted) {
  const std::string given = "speed = \"151.844 rad/s\"";
  const auto bare = doubts_of("vibratory_mill.toml", given, "speed = 1450");
  EXPECT_TRUE(one_says(bare, "857 g"));
  EXPECT_TRUE(one_says(bare, "13846.5 rpm"));
  const auto hertz = doubts_of("vibratory_mill.toml", given, "speed = \"1450 Hz\"");
  EXPECT_TRUE(one_says(hertz, "87000 rpm"));
  EXPECT_TRUE(one_says(hertz, "peripheral speed of 273 m/s"));  // 2 pi 1450 x 30 mm
  for (const char* scene : {"drive_train.toml", "load_table.toml"}) {
    const std::string rpm = std::string(scene) == "load_table.toml" ? "\"510 rpm\"" : "\"1360 rpm\"";
    EXPECT_TRUE(one_says(doubts_of(scene, "speed = " + rpm, "speed = 1450"), "turns at 13846.5 rpm"))
        << scene;
  }
}

TEST(Plausibility, PlanetaryMillsEndAtAHundredG) {
  EXPECT_TRUE(one_says(doubts_of("stub_axle.toml", "speed = \"30 rad/s\"", "speed = \"34 rad/s\""), "106 g"))
      << "0.9 m at 34 rad/s";
}

TEST(Plausibility, ALooseToleranceIsDoubted) {
  EXPECT_TRUE(one_says(doubts_of("load_table.toml", "[machine]", "tolerance = 0.5\n[machine]"), "50 %"));
  EXPECT_TRUE(doubts_of("load_table.toml", "[machine]", "tolerance = 0.2\n[machine]").empty());
}

// Sound along a bar: sqrt(206e6 / 7850) = 162 m/s, sqrt(206e9 / 785) = 16199 m/s; strains: 275e6 / 206e6 =
// 1.3, 1.5e6 / 206e9 = 7.3e-6.
TEST(Plausibility, MaterialsWithAWrongPowerOfTenAreDoubted) {
  const auto with = [](const std::string& key, const std::string& value) {
    const std::string modulus = "youngs_modulus = \"206 GPa\"";
    return doubts_of("load_table.toml", modulus,
                     (key == "youngs_modulus" ? "" : modulus + "\n") + key + " = " + value);
  };
  const auto soft = with("youngs_modulus", "206e6");
  EXPECT_TRUE(one_says(soft, "youngs_modulus = 0.206 GPa and density = 7850 kg/m3 at 162 m/s"));
  EXPECT_TRUE(one_says(soft, "a strain of 1."));
  EXPECT_TRUE(one_says(with("density", "785"), "at 1.62e+04 m/s"));
  EXPECT_TRUE(one_says(with("yield_strength", "\"1.5 MPa\""), "a strain of 7.3e-06"));
  EXPECT_TRUE(with("density", "2700").empty());
  EXPECT_TRUE(with("youngs_modulus", "\"16 GPa\"").empty()) << "as soft as lead";
}

}  // namespace
