// Results of another scene, sweep or --set stay; a command line with a slip says what may have been meant.
#include <algorithm>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

std::string shaft_under(const std::string& force) {
  return small_shaft({{"pull", "middle.fy", force}}, "mm", "600 rpm", "");
}

std::string force_in(const fs::path& results) {
  return std::to_string(
      std::lround(1e-6 * summary(results)["bodies"]["shaft"]["peak_von_mises"]["value"].get<double>()));
}

Outcome expect_done(const fs::path& directory, const std::string& arguments) {
  const auto outcome = millstress(directory, arguments + " -q");
  EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.err;
  return outcome;
}

}  // namespace

// Red if a second set of settings, or another scene of the same name, takes the place of the first.
TEST(Variants, OfARunGoIntoADirectoryOfTheirOwn) {
  const results_test::Directory directory;
  write(directory / "scene.toml", shaft_under("1 kN"));
  const std::string run = "run scene.toml --method beam", more = " --set 'machine.constants[1].value=2 kN'";
  EXPECT_EQ(expect_done(directory.path, run).err, "");
  const auto first = contents(directory / "results/scene");
  const auto second = expect_done(directory.path, run + more);
  EXPECT_EQ(
      second.err,
      "millstress: results/scene holds results of this scene without --set; this goes to results/scene-2 "
      "(--force replaces)\n");
  EXPECT_NE(second.out.find("results in results/scene-2\n"), std::string::npos) << second.out;
  EXPECT_TRUE(contents(directory / "results/scene") == first);
  EXPECT_NE(force_in(directory / "results/scene"), force_in(directory / "results/scene-2"));
  // The same again finds its own.
  EXPECT_NE(millstress(directory.path, run + more).err.find("unchanged since the last run"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(directory / "results/scene-3"));
  // Another scene of that name.
  fs::create_directory(directory / "other");
  write(directory / "other/scene.toml", shaft_under("3 kN"));
  const auto other = expect_done(directory.path, "run other/scene.toml --method beam");
  EXPECT_NE(other.err.find("holds results of another scene, scene.toml; this goes to results/scene-3"),
            std::string::npos)
      << other.err;
  // An edited scene is the same one, and so is one that is computed by other means.
  write(directory / "scene.toml", shaft_under("4 kN"));
  EXPECT_EQ(expect_done(directory.path, run + " --threads 2").err, "");
  EXPECT_FALSE(contents(directory / "results/scene") == first);
  EXPECT_FALSE(fs::exists(directory / "results/scene-4"));
  // --force means it.
  EXPECT_EQ(expect_done(directory.path, run + more + " --force").err, "");
  EXPECT_EQ(summary(directory / "results/scene")["input"]["settings"].size(), 1u);
}

TEST(Variants, InADirectoryThatIsNamedAreRefused) {
  const results_test::Directory directory;
  write(directory / "scene.toml", shaft_under("1 kN"));
  expect_done(directory.path, "run scene.toml --method beam -o out");
  expect_done(directory.path, "sweep scene.toml --loads --vary 'machine.speed = 600, 700 rpm' -o out");
  const auto before = contents(directory / "out");
  for (const std::string command :
       {"run scene.toml --method beam -o ", "ports scene.toml -o ", "calculix scene.toml -o ",
        "accuracy scene.toml -o ", "loads scene.toml --statistics ", "history scene.toml -o ",
        "history scene.toml -o h --results ",
        "sweep scene.toml --loads --vary 'machine.speed = 1, 2 rpm' -o "}) {
    const auto outcome = millstress(directory.path, command + "out -q --set title=another");
    EXPECT_EQ(outcome.exit_code, 2) << command << outcome.err;
    EXPECT_NE(
        outcome.err.find(" out: holds results of this scene without --set; add --force to replace it, or "
                         "choose another directory with -"),
        std::string::npos)
        << command << outcome.err;
    EXPECT_TRUE(contents(directory / "out") == before) << command;
  }
  EXPECT_FALSE(fs::exists(directory / "h"));
  expect_done(directory.path, "run scene.toml --method beam -o out --force --set title=another");
  EXPECT_EQ(summary(directory / "out")["input"]["title"], "another");
}

// A sweep that has all points of the one before adds to it; any other leaves it.
TEST(Variants, OfASweepKeepApartUnlessOneHasAllPointsOfTheOther) {
  const results_test::Directory directory;
  write(directory / "scene.toml", shaft_under("1 kN"));
  const auto sweep = [&](const std::string& options) {
    return expect_done(directory.path, "sweep scene.toml --figure loads.middle.fy.max --vary " + options).err;
  };
  const auto table = directory / "results/scene_sweep/sweep.csv";
  EXPECT_EQ(sweep("'machine.speed = 600..700 rpm / 2' --loads").find("goes to"), std::string::npos);
  EXPECT_EQ(sweep("'machine.speed = 600..700 rpm / 3' --loads").find("goes to"), std::string::npos);
  const auto before = results_test::bytes(table);
  for (const std::string options : {"'machine.speed = 600..700 rpm / 2' --loads",
                                    "'machine.speed = 600..700 rpm / 3' --loads --set title=b"})
    EXPECT_NE(sweep(options).find("goes to results/scene_sweep-"), std::string::npos) << options;
  EXPECT_EQ(results_test::bytes(table), before);
  EXPECT_TRUE(fs::exists(directory / "results/scene_sweep-3/sweep.csv"));
  // Stresses beside the loads add to them; loads alone would take the stresses away.
  EXPECT_EQ(sweep("'machine.speed = 600..700 rpm / 3' --method beam").find("goes to"), std::string::npos);
  EXPECT_NE(sweep("'machine.speed = 600..700 rpm / 3' --loads").find("goes to"), std::string::npos);
}

// Red if --method does not reach the points, or does not come before the scene's and that of --set.
TEST(Variants, SweepsTakeAMethod) {
  const results_test::Directory directory;
  write(directory / "scene.toml", shaft_under("1 kN"));
  const std::string sweep = "sweep scene.toml --json -o out --force --vary 'machine.speed = 600, 700 rpm' ";
  const auto figures = [&](const std::string& options) {
    const auto outcome = expect_done(directory.path, sweep + options);
    const auto points = nlohmann::json::parse(outcome.out)["points"];
    return points[1]["figures"];
  };
  const auto by_key = figures("--set method=beam");
  EXPECT_EQ(figures("--method beam"), by_key);
  EXPECT_EQ(figures("--method beam --set method=solid"), by_key);
  EXPECT_NE(figures("--method axisymmetric"), by_key);
  for (const auto& [options, told] :
       {std::pair("--method beem", "--method beem: unknown model; did you mean \"beam\"?"),
        {"--method solid --loads", "--method: has no use with --loads"},
        {"--method solid --vary 'method = beam, solid'", "--method: has no use where --vary chooses it"}}) {
    const auto outcome = millstress(directory.path, sweep + options);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
  }
}

TEST(CommandLine, TakesShortFormsAndSuggestsNames) {
  const results_test::Directory directory;
  write(directory / "scene.toml", shaft_under("1 kN"));
  EXPECT_NE(expect_done(directory.path, "scene.toml --method beam").out.find("results in results/scene\n"),
            std::string::npos);
  const auto help = millstress(directory.path, "help run");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("--tolerance"), std::string::npos) << help.out;
  EXPECT_EQ(millstress(directory.path, "run --help").out, help.out);
  EXPECT_EQ(millstress(directory.path, "help").out, millstress(directory.path, "--help").out);
  EXPECT_EQ(millstress(directory.path, "-h").exit_code, 0);
  const std::vector<std::pair<std::string, std::string>> slips{
      {"run scene.toml --tolernce '2 %'", "--tolernce: is no option of run; did you mean \"--tolerance\"?"},
      {"run --tolernce '2 %' scene.toml", "--tolernce: is no option of run; did you mean \"--tolerance\"?"},
      {"sweep scene.toml --varry 'a = 1'", "--varry: is no option of sweep; did you mean \"--vary\"?"},
      {"report --methd out", "--methd: is no option of report"},
      {"help rnu", "rnu: is no command; did you mean \"run\"?"},
      {"hlep", "hlep: is no command; did you mean \"help\"?"},
      {"scen.toml", "scen.toml: there is no such file; did you mean \"scene.toml\"?"},
      {"check nowhere/scene.toml", "nowhere/scene.toml: there is no such file; give the path of a scene"},
      {"run scene.toml --method beem", "--method beem: unknown model; did you mean \"beam\"?"},
      {"accuracy scene.toml --body shft", "--body shft: the scene has no such body; did you mean \"shaft\"?"},
      {"sweep scene.toml --design gird", "--design gird: is no design; did you mean \"grid\"?"}};
  for (const auto& [arguments, told] : slips) {
    const auto outcome = as_a_user(directory.path, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << arguments << '\n' << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

// Red if a body cannot be taken out of a scene by one word, or if it is not told what went with it.
TEST(CommandLine, RemovesABodyWithWhatNeedsIt) {
  const results_test::Directory directory;
  const auto run = expect_done(directory.path, "run '" + shipped("vibratory_mill.toml").string() +
                                                   "' --set shaft=removed --set chamber=removed -o out");
  for (const char* effect : {"gravity_shaft", "shaft_inertia"}) {
    const auto told =
        std::string("[shaft] is removed, and with it the effect \"") + effect + "\", which needs it";
    EXPECT_NE(run.out.find(told), std::string::npos) << run.out;
    EXPECT_NE(summary(directory / "out")["warnings"].dump().find(effect), std::string::npos);
  }
}
