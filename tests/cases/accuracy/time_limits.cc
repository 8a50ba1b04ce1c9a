/// Limits of time are asked while long work is at work, and what is left is told.
#include "tests/cases/program/program.h"
#include "tests/cases/program/stepped_shaft.h"

using namespace cases;

namespace {

const nlohmann::json& search_of(const nlohmann::json& summary) {
  return summary["bodies"]["shaft"]["search"];
}

}  // namespace

// A thousandth of a second is over before the first mesh is solved: it stays the result, and what would come
// after it is left out and told. Red where natural frequencies, lives or pictures are made whatever the time.
TEST(TimeLimits, LeaveOutWhatComesAfterTheStress) {
  const results_test::Directory directory;
  write(directory / "small.toml",
        with_edits(stepped_shaft("method = \"solid\"\n"),
                   {{"bearings = ", "natural_frequencies = 1\nbearings = "},
                    {"[shaft.material]", "[shaft.fatigue]\ntensile_strength = \"590 MPa\"\n[shaft.material]"},
                    {"pictures = false", "pictures = true"}}));
  const auto run = millstress(directory.path, "run small.toml -o out --time-limit '0.001 s'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("shaft: natural frequencies are left out, since the time was up"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("shaft: lives are left out, since the time was up"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("shaft: no picture: the time was up"), std::string::npos) << run.err;
  const auto json = summary(directory / "out");
  EXPECT_EQ(search_of(json)["steps"].size(), 1u);
  EXPECT_EQ(search_of(json)["ended"], "the time is up");
  const auto& peak = json["bodies"]["shaft"]["peak_von_mises"];
  EXPECT_GT(peak["error"]["numerical"].get<double>(), 0.05 * peak["value"].get<double>())
      << "no second model";
  EXPECT_TRUE(fs::exists(directory / "out/shaft/envelope.vtu"));
}

// Harmonics refine their section step by step. The first one is always taken, no other begins after the time
// is up, and no solid is meshed for what they have not reached. Red: steps that do not ask, a solid that
// follows.
TEST(TimeLimits, EndTheStepsOfHarmonics) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft());
  const auto run =
      millstress(directory.path, "run small.toml -o out --tolerance '0.1 %' --time-limit '0.01 s'");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  const auto json = summary(directory / "out");
  EXPECT_EQ(json["bodies"]["shaft"]["method"], "axisymmetric");
  EXPECT_EQ(search_of(json)["steps"].size(), 1u);
  EXPECT_EQ(search_of(json)["ended"], "the time is up");
  EXPECT_FALSE(search_of(json)["met"].get<bool>());
}

// `check` looks at measures; a mesh is made where it is asked for. Red where a stage of meshing is there
// without, or missing with it.
TEST(CheckCommand, MeshesWhereItIsAskedTo) {
  const results_test::Directory directory;
  for (const std::string name : {"vibratory_mill.toml", "part.toml"}) {
    const auto check = millstress(directory.path, "check -v '" + shipped(name).string() + "'");
    ASSERT_EQ(check.exit_code, 0) << check.err;
    EXPECT_NE(check.err.find("  describe "), std::string::npos) << check.err;
    EXPECT_EQ(check.err.find("  mesh "), std::string::npos) << check.err;
    EXPECT_NE(check.out.find("first of a search"), std::string::npos) << check.out;
    EXPECT_EQ(check.out.find("scaled Jacobian"), std::string::npos) << check.out;
  }
  write(directory / "small.toml", stepped_shaft());
  const auto thorough = millstress(directory.path, "check -v --thorough small.toml");
  ASSERT_EQ(thorough.exit_code, 0) << thorough.err;
  EXPECT_NE(thorough.err.find("  mesh "), std::string::npos) << thorough.err;
  EXPECT_NE(thorough.out.find("scaled Jacobian"), std::string::npos) << thorough.out;
}

// A port that lies on no surface of a STEP file is found by the mesh alone, and told with the same words by
// `check --thorough` and by `run`.
TEST(CheckCommand, FindsPortsOfAStepFileWhereItIsThorough) {
  const results_test::Directory directory;
  fs::copy_file(shipped("part.step"), directory / "part.step");
  write(directory / "part.toml",
        edited("part.toml", {{"diameter = \"24 mm\", begin", "diameter = \"22 mm\", begin"}}));
  const auto quick = millstress(directory.path, "check part.toml"),
             thorough = millstress(directory.path, "check --thorough part.toml"),
             run = millstress(directory.path, "run part.toml -q -o out");
  EXPECT_EQ(quick.exit_code, 0) << quick.err;
  EXPECT_NE(quick.out.find("--thorough looks for them"), std::string::npos) << quick.out;
  EXPECT_EQ(thorough.exit_code, 2) << thorough.out;
  EXPECT_EQ(run.exit_code, 2) << run.out;
  EXPECT_EQ(thorough.err, run.err);
  EXPECT_NE(thorough.err.find("no surface lies on its cylinder"), std::string::npos) << thorough.err;
}
