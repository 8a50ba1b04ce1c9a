// What a sweep keeps in its directory, takes from there, and leaves alone.
#include "tests/cases/program/program.h"
#include "tests/cases/program/swept_points.h"

using namespace cases;

// The last line of the journal is cut as by a kill, another is damaged: both are computed again, the others
// not.
TEST(Sweeps, ThatWereInterruptedGoOn) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const std::string arguments =
      "mill.toml --loads -o swept --vary 'machine.drive.speed = 1200..1600 rpm / 9'";
  std::string err;
  points_of(directory.path, arguments, &err);
  EXPECT_EQ(err.find("known from"), std::string::npos) << err;
  const auto table = results_test::bytes(directory / "swept/sweep.csv");
  auto journal = results_test::bytes(directory / "swept/journal");
  journal.resize(journal.size() - 20);
  const auto third = journal.find('\n', journal.find('\n') + 1) + 200;
  journal[third] = journal[third] == '1' ? '2' : '1';
  write(directory / "swept/journal", journal);
  fs::remove(directory / "swept/sweep.csv");
  points_of(directory.path, arguments, &err);
  EXPECT_NE(err.find("7 known from"), std::string::npos) << err;
  EXPECT_EQ(results_test::bytes(directory / "swept/sweep.csv"), table);
  write(directory / "mill.toml", shaft_alone(coarse()) + "\n# changed\n");
  points_of(directory.path, arguments, &err);
  EXPECT_EQ(err.find("known from"), std::string::npos) << err;
}

// The journal's rows depend on every file that a point names, not on the first one's alone.
TEST(Sweeps, SeeThatAFileOfALaterPointHasChanged) {
  const results_test::Directory directory;
  const auto samples = [&](const std::string& file, const std::string& force_N) {
    std::string text = "angle [deg],seat.fx [N]\n";
    for (int degree = 0; degree < 360; degree += 15) text += std::to_string(degree) + ',' + force_N + '\n';
    write(directory / file, text);
  };
  samples("a.csv", "1");
  samples("b.csv", "2");
  write(directory / "loads.toml",
        "title = \"loads\"\neffects = [\"pull\"]\n[machine]\ntype = \"load_table\"\nspeed = \"600 rpm\"\n"
        "[[machine.files]]\neffect = \"pull\"\nfile = \"a.csv\"\n"
        "[sampling]\ninstants_per_turn = 24\nturns = 1\n");
  const std::string arguments =
      "loads.toml --loads -o swept --vary 'machine.files[1].file = \"a.csv\", \"b.csv\"'";
  std::string err;
  const auto before = points_of(directory.path, arguments, &err);
  ASSERT_EQ(before.size(), 2u) << err;
  EXPECT_EQ(figure(before[1], "loads.seat.fx.max"), 2);
  points_of(directory.path, arguments, &err);
  EXPECT_NE(err.find("2 known from"), std::string::npos) << err;
  samples("b.csv", "50");
  const auto after = points_of(directory.path, arguments, &err);
  EXPECT_EQ(err.find("known from"), std::string::npos) << err;
  EXPECT_EQ(figure(after[1], "loads.seat.fx.max"), 50);
}

TEST(Sweeps, LeaveNoChartOfOtherPoints) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const std::string speeds = "mill.toml --loads -o swept --vary 'machine.drive.speed = 1400, 1500 rpm'";
  points_of(directory.path, speeds + " --vary 'machine.charge.mass = 10, 20 kg'");
  const bool draws = fs::exists(directory / "swept/map.svg");
  write(directory / "swept/map_notes.txt", "the user's");
  points_of(directory.path, speeds + " --force");
  for (const auto& entry : fs::directory_iterator(directory / "swept"))
    EXPECT_TRUE(entry.path().extension() == ".txt" || entry.path().filename().string().rfind("map", 0) != 0)
        << entry.path();
  EXPECT_TRUE(fs::exists(directory / "swept/map_notes.txt"));
  EXPECT_EQ(fs::exists(directory / "swept/chart.svg"), draws);
  write(directory / "swept/map_7.png", "the user's");
  const auto foreign = as_a_user(directory.path, "sweep " + speeds);
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.err.find("-o swept/map_7.png: is there already"), std::string::npos) << foreign.err;
  EXPECT_EQ(results_test::bytes(directory / "swept/map_7.png"), "the user's");
  fs::remove(directory / "swept/map_7.png");
  fs::create_directory(directory / "swept/chart_3.svg");
  const auto refused = as_a_user(directory.path, "sweep " + speeds);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("chart_3.svg"), std::string::npos) << refused.err;
}

TEST(Sweeps, ReplaceNothingThatIsNotTheirs) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  for (const char* name : {"journal", "sweep.csv"}) {
    fs::create_directories(directory / "mine");
    write(directory / "mine" / name, "a diary\n");
    const auto outcome = as_a_user(
        directory.path, "sweep mill.toml --loads -o mine --vary 'machine.drive.speed = 1400, 1500 rpm'");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(name + std::string(": is there already")), std::string::npos) << outcome.err;
    EXPECT_EQ(results_test::bytes(directory / "mine" / name), "a diary\n");
    fs::remove_all(directory / "mine");
  }
}

// A list of texts has quotes of its own.
TEST(Sweeps, PrintACommandThatAShellTakes) {
  const results_test::Directory directory;
  write(directory / "a mill.toml", shaft_alone(coarse()));
  const auto outcome = as_a_user(directory.path,
                                 "sweep 'a mill.toml' --loads -o swept --vary "
                                 "'machine.springs[1].stiffness = [\"14 kN/m\", \"27 kN/m\"], [\"15 kN/m\", "
                                 "\"27 kN/m\"]' --figure loads.R_E.max");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto begin = outcome.out.find("  millstress loads ") + std::string("  millstress ").size();
  const auto again =
      as_a_user(directory.path, outcome.out.substr(begin, outcome.out.find('\n', begin) - begin));
  EXPECT_EQ(again.exit_code, 0) << again.err;
}
