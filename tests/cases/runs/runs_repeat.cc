#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <regex>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"
#include "tests/cases/program/stepped_shaft.h"

using namespace cases;

namespace {

/// The page with x for the seconds and gigabytes of its last table; the stages' names stay.
std::string without_timing(const fs::path& page) {
  const auto text = results_test::bytes(page);
  const auto table = std::min(text.size(), text.find("<h2>Time and memory"));
  return text.substr(0, table) +
         std::regex_replace(text.substr(table), std::regex("(<td class=\"number\">)[0-9.]+"), "$1x");
}

/// Names of figures that differ by more than the share of the larger, or are there once.
void collect_differences(const nlohmann::json& a, const nlohmann::json& b, double share,
                         const std::string& name, std::vector<std::string>& found) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    if (std::abs(x - y) > share * std::max(std::abs(x), std::abs(y))) found.push_back(name);
  } else if (a.type() == b.type() && a.size() == b.size() && a.is_structured()) {
    for (const auto& [key, value] : a.items())
      if (a.is_object() && !b.contains(key))
        found.push_back(name + "." + key);
      else
        collect_differences(value, a.is_object() ? b.at(key) : b.at(std::stoul(key)), share, name + "." + key,
                            found);
  } else if (a != b) {
    found.push_back(name);
  }
}

std::vector<std::string> differing_figures(const fs::path& a, const fs::path& b, double share) {
  auto first = summary(a), second = summary(b);
  first.erase("timing");
  second.erase("timing");
  std::vector<std::string> found;
  collect_differences(first, second, share, "", found);
  return found;
}

}  // namespace

TEST(Runs, RepeatBitByBitFreshAndReused) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse() + Edits{{"pictures = false", "pictures = true"}}));
  for (const char* out : {"first", "second"}) {
    ASSERT_EQ(millstress(directory.path, std::string("run mill.toml --threads 2 --fresh -o ") + out,
                         as_a_new_process)
                  .exit_code,
              0);
  }
  const auto first = contents(directory / "first");
  const auto second = contents(directory / "second");
  const std::set<std::string> wanted{"loads.h5",
                                     "report.data",
                                     "summary.json",
                                     "manifest.json",
                                     "run.json",
                                     "report.html",
                                     "bodies.vtm",
                                     "paraview_view.py",
                                     "shaft/mesh.msh",
                                     "shaft/envelope.vtu",
                                     "shaft/cycle.pvd",
                                     "shaft/cycle_000.vtu",
                                     "shaft/cycle_001.vtu",
                                     "shaft/zones.csv",
                                     "shaft/zone_tree.csv",
                                     "shaft/diagrams.csv",
                                     "shaft/torsion.csv",
                                     "shaft/fatigue.csv",
                                     "shaft/torsion_cycle.csv"};
  std::set<std::string> found;
  for (const auto& [name, bytes] : first) {
    if (name != "shaft/envelope.png") found.insert(name);  // a machine without EGL draws none
    ASSERT_TRUE(second.count(name)) << name;
    EXPECT_TRUE(bytes == second.at(name)) << name << " differs between two fresh runs";
  }
  EXPECT_EQ(found, wanted);
  EXPECT_TRUE(without_timing(directory / "first/report.html") ==
              without_timing(directory / "second/report.html"));

  // The page holds the headline stress, and can be made again from the files alone, timing and all.
  const auto page = results_test::bytes(directory / "first/report.html");
  char peak[32];
  std::snprintf(peak, sizeof peak, "%.1f MPa \u00b1 ",
                summary(directory / "first")["bodies"]["shaft"]["governing"]["value"].get<double>() / 1e6);
  EXPECT_NE(page.find(peak), std::string::npos) << peak;
  fs::remove(directory / "first/report.html");
  ASSERT_EQ(millstress(directory.path, "report first").exit_code, 0);
  EXPECT_TRUE(results_test::bytes(directory / "first/report.html") == page);
  const auto nowhere = millstress(directory.path, "report elsewhere");
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_NE(nowhere.err.find("elsewhere/summary.json: there is no such file"), std::string::npos)
      << nowhere.err;

  // A third run into the first directory takes the unit responses that are in the cache. It has to compute:
  // what it would repeat is no more on record.
  const auto kept = cached_responses(directory.path, "first");
  EXPECT_EQ(cached_responses(directory.path, "second"), kept);
  const auto before = fs::last_write_time(kept);
  fs::remove(directory / "first/run.json");
  ASSERT_EQ(millstress(directory.path, "run mill.toml --threads 2 -o first", as_a_new_process).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(kept), before);
  const auto reused = contents(directory / "first");
  for (const auto& [name, bytes] : first)
    EXPECT_TRUE(bytes == reused.at(name)) << name << " differs when the unit responses are reused";

  // Another operating point needs no new solve; another material does.
  write(directory / "mill.toml",
        shaft_alone(coarse() + Edits{{"speed = \"151.844 rad/s\"", "speed = \"140 rad/s\""}}));
  ASSERT_EQ(millstress(directory.path, "run mill.toml --threads 2 -o first").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(kept), before);
  EXPECT_EQ(cached_responses(directory.path, "first"), kept);
  EXPECT_NE(summary(directory / "first")["loads"]["R_E"], summary(directory / "second")["loads"]["R_E"]);
  write(directory / "mill.toml", shaft_alone(coarse() + Edits{{"206 GPa", "205 GPa"}}));
  ASSERT_EQ(millstress(directory.path, "run mill.toml --threads 2 -o first").exit_code, 0);
  EXPECT_NE(cached_responses(directory.path, "first"), kept);
}

// Sums over cells are taken by the threads in pieces: figures may differ in their last digits, 1e-12, and no
// more. Natural frequencies are the small remainder of large energies that cancel: 5e-10 were seen of this
// slender shaft, and what follows from them as little.
TEST(Runs, TwoThreadsGiveTheFiguresOfOne) {
  const results_test::Directory directory;
  const std::vector<SmallLoad> loads{{"pull", "middle.fy", "1 kN"}, {"sway", "middle.fx", "300 N", 1}};
  const auto differing = [&](const std::string& keys, double share) {
    write(directory / "scene.toml", small_shaft(loads, "mm", "600 rpm", keys));
    for (const char* threads : {"1", "2"})
      EXPECT_EQ(millstress(directory.path, "run scene.toml --method solid --set results.keep=all --threads " +
                                               std::string(threads) + " -o " + threads)
                    .exit_code,
                0);
    return differing_figures(directory / "1", directory / "2", share);
  };
  EXPECT_EQ(differing("", 1e-12), std::vector<std::string>{});
  EXPECT_EQ(differing("natural_frequencies = 2", 1e-8), std::vector<std::string>{});
  const auto one = csv(directory / "1/loads.csv"), two = csv(directory / "2/loads.csv");
  EXPECT_EQ(one, two);
}

// A body that the scene no longer has takes its files along: they would stand beside a summary that does not
// know them. What a user put there stays, and so does a folder that no run of this program wrote.
TEST(Runs, FilesOfBodiesThatAreGoneAreRemoved) {
  const results_test::Directory directory;
  const auto whole = stepped_shaft();
  auto alone = whole;
  alone.erase(alone.find("[shaft]"), alone.find("[results]") - alone.find("[shaft]"));
  const auto run = [&](const std::string& scene, const std::string& options = "") {
    write(directory / "small.toml", scene);
    return millstress(directory.path, "run small.toml -o out " + options).exit_code;
  };
  const auto out = directory / "out";
  ASSERT_EQ(run(whole, "--method solid --set results.keep=all"), 0);
  ASSERT_TRUE(fs::exists(out / "shaft/unit_responses.h5"));
  ASSERT_TRUE(fs::exists(out / "loads.csv"));
  ASSERT_EQ(run(whole, "--method solid --force"), 0);
  EXPECT_FALSE(fs::exists(out / "shaft/unit_responses.h5"));
  EXPECT_FALSE(fs::exists(out / "loads.csv"));
  ASSERT_EQ(run(alone), 0);
  EXPECT_FALSE(fs::exists(out / "shaft"));
  EXPECT_TRUE(fs::exists(out / "loads.h5"));

  ASSERT_EQ(run(whole, "--method beam"), 0);
  ASSERT_TRUE(fs::exists(out / "shaft/zones.csv"));
  write(out / "shaft/notes.txt", "mine");
  write(out / "shaft/zones_of_last_year.csv", "mine");
  fs::create_directory(out / "chamber");
  write(out / "chamber/zones.csv", "mine: no summary names it");
  ASSERT_EQ(run(alone), 0);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(out / "shaft")) left.insert(entry.path().filename());
  EXPECT_EQ(left, (std::set<std::string>{"notes.txt", "zones_of_last_year.csv"}));
  EXPECT_TRUE(fs::exists(out / "chamber/zones.csv"));

  // A summary that the manifest does not list as it is stops the run.
  write(out / "summary.json", R"({"program": {"name": "millstress"}, "bodies": {"chamber": {}}})");
  EXPECT_EQ(run(alone), 2);
  EXPECT_TRUE(fs::exists(out / "chamber/zones.csv"));
}

TEST(Runs, BrokenUnitResponsesAreSolvedAgain) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  ASSERT_EQ(millstress(directory.path, "run mill.toml -o out").exit_code, 0);
  const auto whole = contents(directory / "out");
  const auto file = cached_responses(directory.path, "out");
  fs::resize_file(file, fs::file_size(file) / 2);
  const auto again = millstress(directory.path, "run mill.toml -q -o out");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err.rfind("millstress: " + file.string() + ": is damaged", 0), 0u) << again.err;
  // The summary and the page have the warning; the next run does not.
  const std::set<std::string> with_warning{"summary.json", "report.html", "report.data", "loads.h5",
                                           "manifest.json"};
  for (const auto& [name, bytes] : contents(directory / "out"))
    EXPECT_TRUE(with_warning.count(name) == 1 || bytes == whole.at(name)) << name;
  const auto warnings = summary(directory / "out")["warnings"].dump();
  EXPECT_NE(warnings.find(".h5: is damaged"), std::string::npos) << warnings;
  ASSERT_EQ(millstress(directory.path, "run mill.toml -o out").exit_code, 0);
  for (const auto& [name, bytes] : contents(directory / "out")) EXPECT_TRUE(bytes == whole.at(name)) << name;
}
