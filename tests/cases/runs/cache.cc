// Unit responses in the user's cache, and what [results] keep leaves beside the summary.
#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

std::string bent_shaft() {
  return small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", "");
}

/// Runs the shaft as a solid, with a variable of the environment.
Outcome run_with(const fs::path& directory, const std::string& variable, const std::string& options) {
  const Start start{directory, "run scene.toml --method solid --tolerance none " + options, "true", variable};
  return outcome_of(start, std::system(shell_command(start).c_str()));
}

std::set<std::string> names_in(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& [name, bytes] : contents(directory)) names.insert(name);
  return names;
}

}  // namespace

// Red if a run ends, or says nothing, where the cache is no directory or may hold nothing; or if its results
// differ.
TEST(Cache, ThatCannotBeWrittenIsToldAndChangesNoResult) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  write(directory / "no_directory", "");
  ASSERT_EQ(run_with(directory.path, "", "-o kept").exit_code, 0);
  const auto without =
      run_with(directory.path, "XDG_CACHE_HOME=" + (directory / "no_directory").string(), "-o without");
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.err.find("shaft: unit responses are not kept for later runs: "), std::string::npos)
      << without.err;
  const auto wrong = run_with(directory.path, "MILLSTRESS_CACHE_LIMIT=much", "-q --fresh -o wrong");
  EXPECT_EQ(wrong.exit_code, 0);
  EXPECT_NE(wrong.err.find("MILLSTRESS_CACHE_LIMIT = much: is no size of the cache in GB"), std::string::npos)
      << wrong.err;
  const auto full = run_with(directory.path, "MILLSTRESS_CACHE_LIMIT=1e-6", "-q --fresh -o full");
  EXPECT_EQ(full.err, "");
  EXPECT_FALSE(fs::exists(cached_responses(directory.path, "full"))) << "larger than the cache may be";
  const auto kept = contents(directory / "kept");
  for (const char* other : {"without", "wrong", "full"})
    EXPECT_TRUE(contents(directory / other) == kept) << other;
}

// Two scenes of one body share its responses, wherever their results are.
TEST(Cache, IsSharedByAllDirectories) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  const auto first = run_with(directory.path, "", "-o first");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out.find("earlier run"), std::string::npos);
  fs::create_directory(directory / "elsewhere");
  write(directory / "elsewhere/scene.toml", with_edits(bent_shaft(), {{"1 kN", "2 kN"}}));
  const auto second = millstress(directory.path, "run elsewhere/scene.toml --method solid -o second");
  EXPECT_NE(second.out.find("responses of an earlier run"), std::string::npos) << second.out;
  EXPECT_EQ(cached_responses(directory.path, "second"), cached_responses(directory.path, "first"));

  const auto told = millstress(directory.path, "cache");
  EXPECT_NE(told.out.find((directory / "cache/millstress").string() + ": 1 unit responses, "),
            std::string::npos)
      << told.out;
  EXPECT_EQ(millstress(directory.path, "cache --clear").exit_code, 0);
  EXPECT_FALSE(fs::exists(cached_responses(directory.path, "first")));
  const auto third = millstress(directory.path, "run elsewhere/scene.toml --method solid --force -o third");
  EXPECT_EQ(third.out.find("earlier run"), std::string::npos) << third.out;
  EXPECT_TRUE(contents(directory / "third") == contents(directory / "second"));
}

// Red if a folder has more or less than the scene asks for, if an unchanged run of the report alone computes,
// or if the page could be lost.
TEST(Cache, KeepSaysWhatStaysBesideTheSummary) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  const auto run = [&](const std::string& keep) {
    return run_with(directory.path, "", "--set results.keep=" + keep + " -o " + keep);
  };
  for (const char* keep : {"results", "all", "report"}) EXPECT_EQ(run(keep).exit_code, 0) << keep;
  auto names = names_in(directory / "results");
  EXPECT_EQ(names.count("shaft/envelope.vtu"), 1u);
  names.insert({"shaft/unit_responses.h5", "loads.csv"});
  EXPECT_EQ(names_in(directory / "all"), names);
  EXPECT_EQ(names_in(directory / "report"),
            (std::set<std::string>{"manifest.json", "report.html", "run.json", "summary.json"}));
  EXPECT_NE(run("report").err.find("unchanged since the last run"), std::string::npos);
  const auto page = results_test::bytes(directory / "report/report.html");
  const auto anew = millstress(directory.path, "report report");
  EXPECT_EQ(anew.exit_code, 2);
  EXPECT_NE(anew.err.find("report: holds the report alone"), std::string::npos) << anew.err;
  EXPECT_EQ(results_test::bytes(directory / "report/report.html"), page);
  const auto history = millstress(directory.path, "history scene.toml --set results.keep=report -o h");
  EXPECT_EQ(history.exit_code, 2);
  EXPECT_NE(history.err.find("keeps the report alone"), std::string::npos) << history.err;
  const auto wrong = run("everything");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("results.keep"), std::string::npos) << wrong.err;
}
