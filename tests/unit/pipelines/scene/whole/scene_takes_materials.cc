// Materials of a scene from the library, by the body's size; what is given wins; fatigue on by default.
// Turns red: the bore counted as steel, a key of the scene passed over, a default that is not told.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/pipelines/examples/edited_scene.h"

namespace {

using edited::has_default;
using pipelines::BodyScene;
using pipelines::Scene;

/// A shaft of two diameters under a force, with these keys of its own.
Scene scene_with(const std::string& keys, const std::string& diameter = "42 mm",
                 const std::string& machine = "", const std::string& of_seats = "") {
  const results_test::Directory at;
  std::ofstream(at / "scene.toml", std::ios::binary) << R"(effects = "all"
[machine]
type = "load_table"
speed = "600 rpm"
constants = [{ effect = "pull", load = "middle.fx", value = "1 kN" }]
)" + machine + R"([shaft]
contour = [{ port = "left", )" + of_seats + R"(diameter = "30 mm", length = "20 mm" }, { fillet = "1 mm" },
           { port = "middle", diameter = ")" + diameter + R"(", length = "60 mm" }, { fillet = "1 mm" },
           { port = "right", )" + of_seats + R"(diameter = "30 mm", length = "20 mm" }]
bearings = ["left", "right"]
)" + keys;
  return pipelines::read_scene(at / "scene.toml");
}

const BodyScene& shaft(const Scene& scene) {
  return *scene.body("shaft");
}

}  // namespace

TEST(SceneMaterial, NameAloneIsEnough) {
  for (const std::string keys : {"material = \"C45+N\"\n", "[shaft.material]\nname = \"C45+N\"\n"}) {
    const auto scene = scene_with(keys);
    const auto& body = shaft(scene);
    EXPECT_EQ(body.material_name, "C45+N");
    EXPECT_EQ(body.material.youngs_modulus_Pa, 210e9);
    EXPECT_EQ(body.material.poisson_ratio, 0.3);
    EXPECT_EQ(body.material.density_kg_m3, 7850);
    EXPECT_EQ(body.yield_strength_Pa, 305e6);
    EXPECT_EQ(body.strength_source, "C45+N, above 16 to 100 mm, EN 10083-2");
    ASSERT_TRUE(body.fatigue);
    EXPECT_EQ(body.fatigue->material.tensile_strength_Pa, 580e6);
    EXPECT_EQ(body.fatigue->strength_source, body.strength_source);
    EXPECT_TRUE(body.fatigue_missing.empty());
    EXPECT_FALSE(body.fatigue_off);
    EXPECT_TRUE(has_default(scene, "shaft.material.yield_strength", "305 MPa"));
    EXPECT_TRUE(has_default(scene, "shaft.material.tensile_strength", "580 MPa"));
    EXPECT_TRUE(has_default(scene, "shaft.material.youngs_modulus", "210 GPa"));
    EXPECT_TRUE(has_default(scene, "shaft.fatigue.roughness", "2.5e-05 m"));
  }
}

// Saarstahl's sheet of C45: 275 and 560 MPa above 100 mm. A bore leaves the section that cools.
TEST(SceneMaterial, StrengthIsThatOfTheSize) {
  EXPECT_EQ(shaft(scene_with("material = \"C45\"\n", "120 mm")).yield_strength_Pa, 275e6);
  const auto bored = scene_with("material = \"C45\"\n", "120 mm\", bore = \"25 mm", "", "bore = \"25 mm\", ");
  EXPECT_EQ(shaft(bored).yield_strength_Pa, 305e6);
  const auto thin = scene_with("[shaft.material]\nname = \"C45\"\nthickness = \"16 mm\"\n");
  EXPECT_EQ(shaft(thin).yield_strength_Pa, 340e6);
}

TEST(SceneMaterial, KeysGivenWin) {
  const auto scene = scene_with(
      "[shaft.material]\nname = \"S355\"\nyoungs_modulus = \"206 GPa\"\npoisson_ratio = 0.28\n"
      "density = 7800\nyield_strength = \"300 MPa\"\ntensile_strength = \"400 MPa\"\ngroup = \"cast "
      "steel\"\n");
  const auto& body = shaft(scene);
  EXPECT_EQ(body.material.youngs_modulus_Pa, 206e9);
  EXPECT_EQ(body.material.poisson_ratio, 0.28);
  EXPECT_EQ(body.material.density_kg_m3, 7800);
  EXPECT_EQ(body.yield_strength_Pa, 300e6);
  ASSERT_TRUE(body.fatigue);
  EXPECT_EQ(body.fatigue->material.tensile_strength_Pa, 400e6);
  EXPECT_EQ(body.fatigue->material.group, pipelines::MaterialGroup::cast_steel);
  EXPECT_EQ(body.strength_source, "");
  const auto of_table = scene_with(
      "[shaft.material]\nname = \"S355\"\ntensile_strength = \"480 MPa\"\n"
      "[shaft.fatigue]\ntensile_strength = \"490 MPa\"\ngroup = \"forging steel\"\n");
  EXPECT_EQ(shaft(of_table).fatigue->material.tensile_strength_Pa, 490e6);
  EXPECT_EQ(shaft(of_table).fatigue->material.group, pipelines::MaterialGroup::forging_steel);
  EXPECT_EQ(shaft(of_table).fatigue->strength_source, "");
}

TEST(SceneMaterial, GroupIsTheMaterials) {
  const auto iron = scene_with("material = \"EN-GJS-400-15\"\n");
  EXPECT_EQ(shaft(iron).fatigue->material.group, pipelines::MaterialGroup::ductile_cast_iron);
  EXPECT_TRUE(has_default(iron, "shaft.fatigue.group", "\"ductile cast iron\""));
}

TEST(SceneFatigue, IsOffWhereTheSceneSaysSo) {
  const auto body = shaft(scene_with("material = \"C45\"\nfatigue = \"off\"\n"));
  EXPECT_FALSE(body.fatigue);
  EXPECT_TRUE(body.fatigue_off);
  EXPECT_TRUE(body.fatigue_missing.empty());
}

TEST(SceneFatigue, OwnMaterialsSayWhatIsMissing) {
  const std::string own =
      "[shaft.material]\nname = \"Specialsteel 7\"\nyoungs_modulus = \"206 GPa\"\npoisson_ratio = 0.3\n"
      "density = \"7850 kg/m3\"\nyield_strength = \"700 MPa\"\n";
  const auto scene = scene_with(own);
  EXPECT_FALSE(shaft(scene).fatigue);
  EXPECT_FALSE(shaft(scene).fatigue_off);
  EXPECT_EQ(
      shaft(scene).fatigue_missing,
      "the tensile strength of \"Specialsteel 7\" is not known; add it: [shaft.material] tensile_strength = "
      "\"... MPa\"");
  EXPECT_TRUE(shaft(scene_with(own + "tensile_strength = \"900 MPa\"\n")).fatigue);
  EXPECT_TRUE(shaft(scene_with(own + "[shaft.fatigue]\ntensile_strength = \"900 MPa\"\n")).fatigue);
}

// A yield strength beyond the library's tensile strength is of another treatment.
TEST(SceneFatigue, YieldAboveTheLibrarysTensileStrengthIsNotJudged) {
  const auto scene = scene_with("[shaft.material]\nname = \"C45\"\nyield_strength = \"600 MPa\"\n");
  EXPECT_FALSE(shaft(scene).fatigue);
  EXPECT_NE(shaft(scene).fatigue_missing.find("600 MPa is above the tensile strength of C45+N"),
            std::string::npos)
      << shaft(scene).fatigue_missing;
}

// Beyond the last range of the standard: the strengths given are the scene's own.
TEST(SceneFatigue, SizeBeyondTheStandardIsNotJudged) {
  const auto scene =
      scene_with("[shaft.material]\nname = \"C45+QT\"\nyield_strength = \"350 MPa\"\n", "120 mm");
  EXPECT_FALSE(shaft(scene).fatigue);
  EXPECT_NE(shaft(scene).fatigue_missing.find("up to 100 mm"), std::string::npos)
      << shaft(scene).fatigue_missing;
}

// By the thickest of its plates of 8 to 15 mm, its housing's ring of 17.5 mm and its pads of 20 mm: 225 MPa,
// and with a ring of 42 mm 215 MPa (EN 10025-2). Turns red: plates alone, which have 235 MPa.
TEST(SceneMaterial, ChambersGoByTheirThickestMember) {
  const auto given = edited::scene("vibratory_mill", {});
  EXPECT_EQ(given.body("chamber")->yield_strength_Pa, 225e6);
  EXPECT_EQ(given.body("chamber")->strength_source, "S235JR, above 16 to 40 mm, EN 10025-2");
  const auto thick =
      edited::scene("vibratory_mill", {{"bore_radius = \"47.5 mm\"", "bore_radius = \"23 mm\""}});
  EXPECT_EQ(thick.body("chamber")->yield_strength_Pa, 215e6);
}

// Of a file nothing is known before it is meshed: its weakest range counts, and is told.
TEST(SceneMaterial, FilesGoByTheirThicknessOrTheWeakestRange) {
  const edited::Edits file = {
      {"file = \"part.step\"", "file = \"" SOURCE_DIR "/pipelines/scenes/part.step\""}};
  EXPECT_EQ(edited::scene("part", file).body("part")->yield_strength_Pa, 650e6);
  auto without = file;
  without.push_back({"thickness = \"45 mm\"", ""});
  const auto scene = edited::scene("part", without);
  EXPECT_EQ(scene.body("part")->yield_strength_Pa, 500e6);
  const auto told = std::find_if(scene.defaults.begin(), scene.defaults.end(),
                                 [](const auto& used) { return used.key == "part.material.yield_strength"; });
  ASSERT_NE(told, scene.defaults.end());
  EXPECT_NE(told->reason.find("weakest of all sizes: thickness is not given"), std::string::npos);
}
