// `millstress init`: scenes to begin with.
#include <algorithm>

#include "tests/cases/program/program.h"

using namespace cases;

namespace {

/// Of every kind the files that it writes beside the scene.
const std::map<std::string, std::string> kinds{{"vibratory_mill", ""}, {"planetary_mill", ""},
                                               {"drive_train", ""},    {"load_table", "belt_pull.csv"},
                                               {"shaft", ""},          {"part", "part.step"}};

void expect_refused(const fs::path& directory, const std::string& arguments, const std::string& message) {
  const auto outcome = millstress(directory, arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
  EXPECT_EQ(outcome.err, "millstress: " + message + "\n") << arguments;
  EXPECT_EQ(outcome.out, "") << arguments;
}

}  // namespace

// As they are shipped, where another test checks all of them (ShippedScenes).
TEST(Init, EveryKindIsWrittenAsItIsShipped) {
  for (const auto& [kind, input] : kinds) {
    const results_test::Directory directory;
    const auto written = millstress(directory.path, "init " + kind);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    const auto scene = kind + ".toml";
    EXPECT_EQ(written.out, scene + ": a scene that runs; its comments say what to change\n" +
                               (input.empty() ? "" : input + ": is read by it\n") +
                               "next:\n  millstress check " + scene + "\n  millstress run " + scene + "\n");
    EXPECT_EQ(written.err, "");
    const auto n_files = std::distance(fs::directory_iterator(directory.path), {});
    EXPECT_EQ(n_files, input.empty() ? 1 : 2) << kind;
    EXPECT_TRUE(results_test::bytes(directory / scene) == results_test::bytes(shipped(scene))) << kind;
    if (input.empty()) continue;
    EXPECT_TRUE(results_test::bytes(directory / input) == results_test::bytes(shipped(input))) << kind;
  }
}

TEST(Init, ItsScenesRun) {
  const results_test::Directory directory;
  const std::vector<std::pair<std::string, std::string>> runs{
      {"shaft", "--method beam"},
      {"load_table", "--method beam --set results.pictures=false"},
      {"drive_train", ""}};
  for (const auto& [kind, options] : runs) {
    ASSERT_EQ(millstress(directory.path, "init " + kind + " -o 'my scenes/" + kind + ".toml'").exit_code, 0);
    const auto run = millstress(directory.path, "run 'my scenes/" + kind + ".toml' " + options);
    EXPECT_EQ(run.exit_code, 0) << kind << run.err;
    EXPECT_FALSE(summary(directory / "results" / kind)["loads"].empty()) << kind;
  }
  // The part alone is like no other scene: from a file, with a hole that the stress flows round.
  ASSERT_EQ(millstress(directory.path, "init part").exit_code, 0);
  const auto part = millstress(directory.path,
                               "run part.toml --set results.snapshots=0 --set results.pictures=false --set "
                               "part.mesh.cells_per_circle=6 "
                               "--set 'part.mesh.size=\"20 mm\"'");
  ASSERT_EQ(part.exit_code, 0) << part.err;
  const auto results = summary(directory / "results/part");
  EXPECT_LT(results["closure"]["part"]["force"].get<double>(), 1e-9);
  // The drawing's volume: four cylinders of 130 408 mm3, three fillets of 447 mm3 by Pappus, less the hole of
  // 8 mm across 40 mm, 2000 mm3. Six curved cells round a circle miss less than a thousandth.
  EXPECT_NEAR(results["bodies"]["part"]["mass"]["value"].get<double>(), 128.855e3 * 7.85e-6, 0.001);
}

TEST(Init, ReplacesNothing) {
  const results_test::Directory directory;
  write(directory / "shaft.toml", "mine");
  expect_refused(directory.path, "init shaft",
                 "shaft.toml: is there already, and is not replaced; give -o a new name, or move it away");
  fs::create_symlink("nowhere", directory / "link.toml");
  expect_refused(directory.path, "init shaft -o link.toml",
                 "link.toml: is there already, and is not replaced; give -o a new name, or move it away");
  fs::create_directory(directory / "folder");
  expect_refused(directory.path, "init shaft -o folder",
                 "folder: is there already, and is not replaced; give -o a new name, or move it away");
  EXPECT_FALSE(fs::exists(directory / "nowhere"));
  EXPECT_EQ(results_test::bytes(directory / "shaft.toml"), "mine");

  // Its table is not replaced either, and no scene is left without one.
  write(directory / "belt_pull.csv", "mine");
  expect_refused(directory.path, "init load_table",
                 "belt_pull.csv: is there already, and is not replaced; the scene needs a file of this name: "
                 "move it away, or give -o another folder");
  EXPECT_FALSE(fs::exists(directory / "load_table.toml"));
  EXPECT_EQ(results_test::bytes(directory / "belt_pull.csv"), "mine");
  const auto same = millstress(directory.path, "init load_table -o new.csv/belt_pull.csv");
  EXPECT_EQ(same.exit_code, 2) << same.err;
  EXPECT_FALSE(fs::exists(directory / "new.csv/belt_pull.csv"));

  // Two scenes may share the same table.
  fs::remove(directory / "belt_pull.csv");
  EXPECT_EQ(millstress(directory.path, "init load_table").exit_code, 0);
  const auto second = millstress(directory.path, "init load_table -o \"it's mine.toml\"");
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.out.find("\n  millstress run 'it'\\''s mine.toml'\n"), std::string::npos) << second.out;
}

TEST(Init, NamesTheKindsThatThereAre) {
  const results_test::Directory directory;
  expect_refused(directory.path, "init shafts",
                 "init shafts: is no kind of scene; did you mean \"shaft\"?; the kinds are: vibratory_mill, "
                 "planetary_mill, drive_train, load_table, shaft, part");
  expect_refused(directory.path, "init bicycle",
                 "init bicycle: is no kind of scene; the kinds are: vibratory_mill, planetary_mill, "
                 "drive_train, load_table, shaft, part");
  const auto without = millstress(directory.path, "init");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("kind is required"), std::string::npos) << without.err;
  EXPECT_TRUE(fs::is_empty(directory.path)) << "but for what the shell wrote";
}
