/// Fatigue is judged where the strength is known, and costs nothing where it is off.
#include "tests/cases/program/field_tables.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

const std::vector<SmallLoad> turning_pull = {{"pull", "middle.fx", "100 N", 1},
                                             {"pull", "middle.fy", "100 N", 1, "90 deg"}};

/// The small shaft of a material by its name, with keys of the shaft.
std::string of_material(const std::string& name, const std::string& keys = "pressure_harmonics = 0") {
  auto scene = small_shaft(turning_pull, "mm", "600 rpm", keys);
  const std::string given = "name = \"steel\"";
  return scene.replace(scene.find(given), given.size(), "name = \"" + name + "\"");
}

bool has_file(const fs::path& directory, const std::string& name) {
  return fs::exists(directory / "out" / "shaft" / name);
}

}  // namespace

// By every method, and of the strength that EN 10083-2 has for 10 mm. Turns red: fatigue only where a table
// asks for it; the strength of another size.
TEST(FatigueByDefault, IsJudgedOfTheLibrarysSteel) {
  const results_test::Directory directory;
  for (const std::string method : {"beam", "axisymmetric", "solid"}) {
    std::string out;
    const auto shaft = run_small(directory.path,
                                 "method = \"" + method + "\"\ntolerance = \"none\"\n" + of_material("C45+N"),
                                 &out)["bodies"]["shaft"];
    ASSERT_TRUE(shaft.contains("fatigue")) << method;
    EXPECT_GT(shaft["fatigue"]["places"].size(), 0u) << method;
    const auto files = expect_fields_of_readme(directory.path / "out");
    std::set<std::string> expected{"fatigue.csv", "zone_tree.csv", "zones.csv"};
    if (method != "beam") expected.insert({"diagrams.csv", "torsion.csv"});
    EXPECT_EQ(files, expected) << method;
    const std::string strength = shaft["fatigue_strength"];
    EXPECT_NE(strength.find("R_m 620 MPa of the part at its size: C45+N, up to 16 mm, EN 10083-2"),
              std::string::npos)
        << strength;
    EXPECT_EQ(strength.find("K_d"), std::string::npos) << strength;
  }
}

// The same stresses to the last bit, no stage, no file. Turns red: a run that judges and throws away.
TEST(FatigueByDefault, CostsNothingWhereItIsOff) {
  const results_test::Directory directory;
  const auto on = run_small(directory.path, "tolerance = \"none\"\n" + of_material("C45+N"));
  EXPECT_TRUE(on["timing"].contains("fatigue"));
  const auto off =
      run_small(directory.path,
                "tolerance = \"none\"\n" + of_material("C45+N", "pressure_harmonics = 0\nfatigue = \"off\""));
  EXPECT_FALSE(off["timing"].contains("fatigue"));
  EXPECT_FALSE(off["bodies"]["shaft"].contains("fatigue"));
  EXPECT_FALSE(has_file(directory.path, "fatigue.csv"));
  EXPECT_EQ(on["bodies"]["shaft"]["peak_von_mises"], off["bodies"]["shaft"]["peak_von_mises"]);
}

// A material of one's own without a tensile strength is not judged, and the run does not fail for it.
TEST(FatigueByDefault, IsNotJudgedWithoutATensileStrength) {
  const results_test::Directory directory;
  const auto json = run_small(directory.path, "tolerance = \"none\"\n" + of_material("own steel"));
  EXPECT_FALSE(json["timing"].contains("fatigue"));
  EXPECT_FALSE(has_file(directory.path, "fatigue.csv"));
}

TEST(FatigueByDefault, LibraryIsListed) {
  const results_test::Directory directory;
  const auto all = millstress(directory.path, "materials");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* name : {"S355J2", "42CrMo4+QT", "EN-GJS-400-15", "EN AW-6082 T6", "X5CrNi18-10"})
    EXPECT_NE(all.out.find(name), std::string::npos) << name;
  const auto one = json_of(directory.path, "materials s355 --json");
  ASSERT_EQ(one["materials"].size(), 1u);
  EXPECT_EQ(one["materials"][0]["name"], "S355J2");
  EXPECT_EQ(one["materials"][0]["strengths"][0]["yield_strength_Pa"], 355e6);
  const auto wrong = millstress(directory.path, "materials S355J3");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("S355J2"), std::string::npos) << wrong.err;
}
