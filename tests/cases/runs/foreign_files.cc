// Files of others in the directories that commands write into: each name that a command may give stops it if
// somebody else has given it, before anything is touched.
#include <algorithm>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// What a command is called with before the name of its output, the option that a refusal names, and names
/// below the output that it may give.
struct WritingCommand {
  std::string arguments, option;
  std::vector<std::string> names;
};

std::vector<WritingCommand> writing_commands() {
  const auto mill = "'" + shipped("vibratory_mill.toml").string() + "'";
  const auto train = "'" + shipped("drive_train.toml").string() + "'";
  return {{"run small.toml -q -o ",
           "-o",
           {"manifest.json",
            "summary.json",
            "run.json",
            "report.html",
            "report.data",
            "loads.h5",
            "loads.csv",
            "duty.csv",
            "bodies.vtm",
            "paraview_view.py",
            "torsion/modes.csv",
            "shaft/mesh.msh",
            "shaft/zones.csv",
            "shaft/zone_tree.csv",
            "shaft/hot_spots.csv",
            "shaft/fatigue.csv",
            "shaft/weld_fatigue.csv",
            "shaft/diagrams.csv",
            "shaft/torsion.csv",
            "shaft/start_up.csv",
            "shaft/element_torques.csv",
            "shaft/envelope.vtu",
            "shaft/envelope.pvtu",
            "shaft/envelope_0.vtu",
            "shaft/envelope.png",
            "shaft/cycle.pvd",
            "shaft/cycle_000.vtu",
            "shaft/cycle_017.vtu",
            "shaft/unit_responses.h5",
            "shaft/torsion_cycle.csv"}},
          {"loads small.toml -q --statistics ",
           "--statistics",
           {"manifest.json", "statistics.csv", "harmonics.csv", "polar.csv", "spectrum.csv", "histories.png",
            "histories.svg", "polar.png", "polar.svg", "harmonics.png", "harmonics.svg", "rainflow.png",
            "rainflow.svg"}},
          {"calculix small.toml -q -o ", "-o", {"manifest.json", "shaft.inp"}},
          {"ports small.toml -q -o ", "-o", {"manifest.json", "shaft/ports.vtu", "shaft/ports.png"}},
          {"history small.toml -q -o ",
           "-o",
           {"manifest.json", "histories.h5", "shaft_zone_1.csv", "shaft_node_7.csv", "shaft_middle.csv"}},
          {"sweep small.toml -q --loads --vary 'machine.constants[1].value = 1, 2 N' -o ",
           "-o",
           {"manifest.json", "journal", "sweep.csv", "sweep.h5", "zones.csv", "map.png", "map_2.svg",
            "chart.png", "chart_7.png"}},
          {"accuracy small.toml -q -o ",
           "-o",
           {"accuracy/manifest.json", "accuracy/accuracy.h5", "accuracy/shaft.txt", "accuracy/shaft.csv",
            "accuracy/shaft_gci.csv", "accuracy/shaft.png"}},
          {"torsion " + train + " -q -o ",
           "-o",
           {"manifest.json", "modes.csv", "forced.csv", "campbell.csv", "transient.csv", "margins.csv",
            "table_1.csv", "tables_2_3.csv", "campbell.png", "campbell.svg", "modes.png", "modes.svg"}},
          {"free-body " + mill + " -q -o ",
           "-o",
           {"manifest.json", "free_body.csv", "free_body.pvd", "free_body.png", "free_body.svg",
            "free_body_000.vtp", "free_body_123456.vtp"}}};
}

/// Everything in a directory, links by where they lead.
std::map<std::string, std::string> all_in(const fs::path& directory) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    found[fs::relative(entry.path(), directory).string()] =
        entry.is_symlink()        ? "link to " + fs::read_symlink(entry.path()).string()
        : entry.is_regular_file() ? results_test::bytes(entry.path())
                                  : "no file";
  return found;
}

/// Text that could be any of the formats, and is none of this program.
const std::string foreign_text = "{\"name\": \"mine\", \"files\": {}}\n";

class ForeignFiles : public testing::Test {
protected:
  ForeignFiles() {
    write(directory_ / "small.toml", small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", ""));
  }

  /// That the command is refused and leaves the folder as it is.
  void expect_refused(const WritingCommand& command, const std::string& fragment) {
    const auto before = all_in(directory_ / "out");
    const auto outcome = millstress(directory_.path, command.arguments + "out --force");
    EXPECT_EQ(outcome.exit_code, 2) << command.arguments << fragment << outcome.err;
    EXPECT_NE(outcome.err.find("millstress: " + command.option + " out/" + fragment), std::string::npos)
        << command.arguments << fragment << '\n'
        << outcome.err;
    EXPECT_NE(outcome.err.find("move it away"), std::string::npos) << outcome.err;
    EXPECT_TRUE(all_in(directory_ / "out") == before) << command.arguments << fragment;
    EXPECT_FALSE(fs::exists(directory_ / "results")) << command.arguments << fragment;
  }

  void put(const std::string& name) {
    fs::remove_all(directory_ / "out");
    fs::create_directories((directory_ / "out" / name).parent_path());
    write(directory_ / "out" / name, foreign_text);
  }

  results_test::Directory directory_;
};

// Red if a name is missing in the lists that commands give, or if ownership is judged by a name's existence.
TEST_F(ForeignFiles, UnderEachNameStopEachCommand) {
  for (const auto& command : writing_commands())
    for (const auto& name : command.names) {
      put(name);
      expect_refused(command, name + ": is there already");
      if (HasFailure()) return;
    }
}

// A manifest of this program beside it does not make a file this program's.
TEST_F(ForeignFiles, BesideAManifestStopEachCommandToo) {
  ASSERT_EQ(millstress(directory_.path, "loads small.toml -q --statistics other").exit_code, 0);
  for (const auto& command : writing_commands()) {
    const auto& name = command.names.back();
    put(name);
    if (command.names.front() != "accuracy/manifest.json")
      fs::copy_file(directory_ / "other/manifest.json", directory_ / "out/manifest.json");
    expect_refused(command, name + ": is there already");
  }
}

// Links, also those that lead to what this program wrote, and folders that are links.
TEST_F(ForeignFiles, LinksStopEachCommand) {
  for (const auto& command : writing_commands()) {
    const auto& name = command.names.back();
    put(name);
    fs::rename(directory_ / "out" / name, directory_ / "elsewhere");
    fs::create_symlink(directory_ / "elsewhere", directory_ / "out" / name);
    expect_refused(command, name + ": is a symbolic link");
    EXPECT_EQ(results_test::bytes(directory_ / "elsewhere"), foreign_text);
    if (name.find('/') == std::string::npos || name.rfind("accuracy/", 0) == 0) continue;
    fs::remove_all(directory_ / "out");
    fs::remove_all(directory_ / "victim");
    fs::create_directory(directory_ / "out");
    fs::create_directory(directory_ / "victim");
    const auto folder = name.substr(0, name.find('/'));
    fs::create_directory_symlink("../victim", directory_ / "out" / folder);
    expect_refused(command, folder + ": is a symbolic link");
    EXPECT_TRUE(fs::is_empty(directory_ / "victim"));
  }
}

// Single files are known by what they begin with.
TEST_F(ForeignFiles, InThePlaceOfSingleFilesStopLoads) {
  const std::tuple<std::string, std::string, std::string> outputs[] = {
      {"-o mine.h5", "--output mine.h5", "mine.h5"},
      {"--csv mine.csv", "--csv mine.csv", "mine.csv"},
      {"--calculix mine", "--calculix mine_amplitudes.inp", "mine_amplitudes.inp"},
      {"--calculix mine", "--calculix mine_loads.inp", "mine_loads.inp"}};
  for (const auto& [arguments, told, name] : outputs) {
    write(directory_ / name, "** cards of mine\n");
    const auto before = all_in(directory_.path);
    const auto refused = millstress(directory_.path, "loads small.toml -q " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_NE(refused.err.find(told + ": is there already"), std::string::npos) << refused.err;
    EXPECT_TRUE(all_in(directory_.path) == before) << arguments;
    fs::remove(directory_ / name);
    for (int again = 0; again < 2; ++again)
      EXPECT_EQ(millstress(directory_.path, "loads small.toml -q " + arguments).exit_code, 0) << arguments;
    fs::remove(directory_ / name);
  }
}

// Commands share a directory, and each takes back what it wrote.
TEST_F(ForeignFiles, OwnFilesAreReplacedBesideThoseOfOtherCommands) {
  const std::string commands[] = {"run small.toml --method beam --fresh -q -o out",
                                  "ports small.toml -q -o out", "calculix small.toml -q -o out",
                                  "loads small.toml -q --statistics out",
                                  "history small.toml -q --method solid --results solid -o out"};
  for (int again = 0; again < 2; ++again)
    for (const auto& command : commands) {
      const auto outcome = millstress(directory_.path, command);
      EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
    }
  EXPECT_EQ(millstress(directory_.path, "report out").exit_code, 0);
  EXPECT_NE(millstress(directory_.path, "run small.toml --method beam -o out").err.find("unchanged"),
            std::string::npos);
  for (const char* name :
       {"shaft/ports.vtu", "shaft.inp", "statistics.csv", "shaft/zones.csv", "histories.h5"})
    EXPECT_TRUE(fs::exists(directory_ / "out" / name)) << name;
}

// A page that somebody has changed is not made anew over what he wrote.
TEST_F(ForeignFiles, APageIsReplacedIfItIsAsItWasMade) {
  ASSERT_EQ(millstress(directory_.path, "run small.toml --method beam -q -o out").exit_code, 0);
  const auto page = directory_ / "out/report.html";
  const auto text = results_test::bytes(page);
  write(page, text + "<!-- a note -->");
  const auto refused = millstress(directory_.path, "report out");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("report out/report.html: is there already"), std::string::npos) << refused.err;
  EXPECT_EQ(results_test::bytes(page), text + "<!-- a note -->");
  write(page, text);
  EXPECT_EQ(millstress(directory_.path, "report out").exit_code, 0);
}

// A disk that is full while a library writes a chart: the earlier chart stays.
TEST_F(ForeignFiles, AFullDiskLeavesTheEarlierCharts) {
  const std::string statistics = "loads small.toml -q --statistics out";
  ASSERT_EQ(millstress(directory_.path, statistics).exit_code, 0);
  if (!fs::exists(directory_ / "out/histories.svg"))
    GTEST_SKIP() << "without OpenGL the program draws no charts: there is none to lose";
  auto before = all_in(directory_ / "out");
  const auto largest = fs::file_size(directory_ / "out/histories.svg");
  int n_refused = 0;
  for (auto blocks = (largest - 1) / 512; blocks > 4; blocks = blocks * 3 / 4) {
    // A file may have so many blocks of 512 bytes.
    const auto outcome =
        millstress(directory_.path, statistics, "trap '' XFSZ && ulimit -f " + std::to_string(blocks));
    if (outcome.exit_code != 0) {
      ++n_refused;
      EXPECT_EQ(outcome.exit_code, 3) << blocks << outcome.err;
      EXPECT_TRUE(all_in(directory_ / "out") == before) << blocks;
      continue;
    }
    // Then it did not draw: what draws needs large files of its own. The next one begins with charts again.
    EXPECT_FALSE(fs::exists(directory_ / "out/histories.svg")) << blocks;
    ASSERT_EQ(millstress(directory_.path, statistics).exit_code, 0);
    before = all_in(directory_ / "out");
  }
  EXPECT_GT(n_refused, 0);
}

}  // namespace
