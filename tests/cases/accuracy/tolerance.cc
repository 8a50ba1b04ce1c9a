#include <chrono>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"
#include "tests/cases/program/stepped_shaft.h"

using namespace cases;

namespace {

const nlohmann::json& shaft_of(const nlohmann::json& summary) {
  return summary["bodies"]["shaft"];
}

/// A search on solid cells: by itself a run would take harmonics around the axis.
std::string solid_shaft(const std::string& keys = "") {
  return stepped_shaft("method = \"solid\"\n" + keys);
}

double peak_MPa(const nlohmann::json& summary) {
  return shaft_of(summary)["peak_von_mises"]["value"].get<double>() / 1e6;
}

}  // namespace

// A stricter tolerance walks the same way further: its first steps are those of the looser one. Each ends
// within its tolerance of the strictest, whose own error is a twentieth.
TEST(Tolerance, EachIsMetAgainstTheStrictest) {
  const results_test::Directory directory;
  write(directory / "small.toml", solid_shaft());
  std::map<std::string, nlohmann::json> results;
  for (const std::string percent : {"20", "1"}) {
    const auto run =
        millstress(directory.path, "run small.toml -o " + percent + " --tolerance '" + percent + " %'");
    ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
    results[percent] = summary(directory / percent);
    const auto& search = shaft_of(results[percent])["search"];
    EXPECT_TRUE(search["met"].get<bool>());
    const auto& error = shaft_of(results[percent])["peak_von_mises"]["error"];
    EXPECT_LE(error["numerical"].get<double>() / 1e6, std::stod(percent) / 100 * peak_MPa(results[percent]));
  }
  const double best_MPa = peak_MPa(results["1"]);
  for (const std::string percent : {"20"}) {
    EXPECT_NEAR(peak_MPa(results[percent]), best_MPa, std::stod(percent) / 100 * best_MPa) << percent;
    const auto& steps = shaft_of(results[percent])["search"]["steps"];
    const auto& all = shaft_of(results["1"])["search"]["steps"];
    ASSERT_LE(steps.size(), all.size());
    for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], all[i]) << percent << ' ' << i;
  }
  EXPECT_GT(shaft_of(results["1"])["search"]["steps"].size(),
            shaft_of(results["20"])["search"]["steps"].size());
  EXPECT_TRUE(fs::exists(cached_responses(directory.path, "1")));
}

// Torsion of order 37 at 148 instants a turn, four in its period and all 45 degrees off a crest: harmonics
// and the beam, too, take as many as the crest asks for, and state the stress that a run with 1200 has. Red
// if the tolerance is not met for want of instants.
TEST(Tolerance, ModelsWithoutAMeshTakeTheInstantsThatItAsksFor) {
  const results_test::Directory directory;
  const auto with = [&](const std::string& method, const std::string& instants) {
    auto scene = small_shaft({{"drive", "middle.torque", "45 N m", 37, "45 deg"}}, "mm", "600 rpm",
                             "pressure_harmonics = 0");
    const std::string given = "instants_per_turn = 24";
    scene.replace(scene.find(given), given.size(), "instants_per_turn = " + instants);
    write(directory / "small.toml", "method = \"" + method + "\"\n" + scene);
    const auto run = millstress(directory.path, "run small.toml -o " + method + instants + " --tolerance '" +
                                                    (method == "beam" ? "40 %'" : "3 %'"));
    EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
    return summary(directory / (method + instants));
  };
  for (const std::string method : {"axisymmetric", "beam"}) {
    const auto few = with(method, "148"), many = with(method, "1200");
    EXPECT_NEAR(peak_MPa(few), peak_MPa(many), 0.03 * peak_MPa(many)) << method;
    EXPECT_TRUE(shaft_of(few)["search"]["met"].get<bool>()) << method;
    const auto& steps = shaft_of(few)["search"]["steps"];
    EXPECT_EQ(steps.front()["instants_per_turn"], 148);
    EXPECT_GT(steps.back()["instants_per_turn"].get<int>(), 148) << "the crest is met";
    EXPECT_EQ(few["input"]["instants_per_turn"], steps.back()["instants_per_turn"]);
    EXPECT_EQ(shaft_of(many)["search"]["steps"].back()["instants_per_turn"], 1200);
  }
}

// Time that is up keeps what there is: exit code 4, results whole, and a word on what the rest would cost.
TEST(Tolerance, NotMetInTimeKeepsTheResults) {
  const results_test::Directory directory;
  write(directory / "small.toml", solid_shaft("tolerance = \"0.01 %\"\ntime_limit = \"3 s\""));
  const auto run = millstress(directory.path, "run small.toml -o out");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.err.find("tolerance is not met"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("the next step needs about"), std::string::npos) << run.out;
  const auto json = summary(directory / "out");
  EXPECT_FALSE(shaft_of(json)["search"]["met"].get<bool>());
  EXPECT_TRUE(fs::exists(directory / "out/shaft/envelope.vtu"));
  EXPECT_TRUE(fs::exists(directory / "out/loads.h5"));
}

// What harmonics beside the first mesh cost is no forecast of the next one: a disc that spins, of 432
// unknowns, was given up since "the next step needs about 129 s"; it needs a second. Turns red: the seconds
// of the whole step times the growth of the unknowns.
TEST(Tolerance, ASecondModelIsNoForecastOfTheNextMesh) {
  const results_test::Directory directory;
  write(directory / "disc.toml", R"(effects = "all"
method = "solid"
[machine]
type = "load_table"
speed = "9000 rpm"
constants = [{ effect = "spin", load = "volume.spin", value = 888264 }]
[shaft]
contour = [{ name = "disc", diameter = "400 mm", length = "6 mm", bore = "80 mm" }])" +
                                     steel_of("shaft") + "[results]\npictures = false\nsnapshots = 0\n");
  const std::string search = "run disc.toml -o out --fresh --tolerance '5 %' --time-limit '";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(millstress(directory.path, search + "1000 s'").exit_code, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto run = millstress(directory.path, search + std::to_string(3 * seconds) + " s'");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_TRUE(shaft_of(summary(directory / "out"))["search"]["met"].get<bool>());
}

// A search whose next mesh does not fit into the memory that the process may have keeps the last one that
// did.
TEST(Tolerance, AMeshThatDoesNotFitEndsTheSearchWithWhatItHas) {
  const results_test::Directory directory;
  write(directory / "small.toml",
        with_edits(solid_shaft("tolerance = \"0.01 %\""), {{"[shaft]", "[shaft]\nsolver = \"direct\""}}));
  const auto run = millstress(directory.path, "run small.toml -o out", "ulimit -d 1000000");
  EXPECT_EQ(run.exit_code, 4) << run.err << run.out;
  EXPECT_NE(run.out.find("does not fit into memory"), std::string::npos) << run.out;
  const auto json = summary(directory / "out");
  const auto& search = shaft_of(json)["search"];
  EXPECT_FALSE(search["met"].get<bool>());
  ASSERT_GE(search["steps"].size(), 2U);
  EXPECT_EQ(shaft_of(json)["dofs"], search["steps"].back()["dofs"]);
  for (const std::string file : {"mesh.msh", "envelope.vtu"})
    EXPECT_TRUE(fs::exists(directory / "out/shaft" / file)) << file;
  EXPECT_TRUE(fs::exists(cached_responses(directory.path, "out")));
}

// `check --thorough` knows the meshes of a run and of a search to the last unknown, and the solver's memory
// to a factor of two. By formula, unknowns are within a third. Runs do not change what the next forecast
// says.
TEST(Tolerance, CheckForecastsTheModels) {
  const results_test::Directory directory;
  write(directory / "small.toml", solid_shaft());
  struct Model {
    double unknowns = 0, solve_s = 0, superpose_s = 0, gigabytes = 0;
  };
  const auto forecast = [&](const std::string& model, const std::string& how = "--thorough") {
    const auto check = millstress(directory.path, "check -v small.toml " + how);
    EXPECT_EQ(check.exit_code, 0) << check.err;
    const auto at = check.out.find(model);
    EXPECT_NE(at, std::string::npos) << model << check.out;
    std::istringstream numbers(check.out.substr(at == std::string::npos ? 0 : at + model.size()));
    Model result;
    numbers >> result.unknowns >> result.solve_s >> result.superpose_s >> result.gigabytes;
    return result;
  };
  const auto once = forecast("the scene's mesh"), first = forecast("first of a search"),
             finer = forecast("even mesh, cells 1/2");
  EXPECT_NEAR(finer.unknowns, 8 * once.unknowns, 8);
  EXPECT_GT(finer.solve_s, 4 * once.solve_s);
  const double by_formula = forecast("the scene's mesh", "").unknowns;
  EXPECT_GT(by_formula, once.unknowns / 1.34);
  EXPECT_LT(by_formula, once.unknowns * 1.34);

  ASSERT_EQ(millstress(directory.path, "run small.toml -o once").exit_code, 0);
  const auto run = shaft_of(summary(directory / "once"));
  EXPECT_EQ(run["dofs"].get<double>(), once.unknowns);
  const double used_GB = run["solver"]["bytes"].get<double>() / 1e9;
  EXPECT_LT(once.gigabytes, 2 * used_GB);
  EXPECT_GT(once.gigabytes, used_GB / 2);
  ASSERT_EQ(millstress(directory.path, "run small.toml -o search --tolerance '50 %'").exit_code, 0);
  EXPECT_EQ(shaft_of(summary(directory / "search"))["search"]["steps"][0]["dofs"].get<double>(),
            first.unknowns);
  const auto again = forecast("the scene's mesh");
  EXPECT_EQ(again.solve_s, once.solve_s);
  EXPECT_EQ(again.superpose_s, once.superpose_s);
}

// The last mesh of a search is kept with its responses: the same run again solves that mesh no more.
TEST(Tolerance, SecondRunReusesTheLastMesh) {
  const results_test::Directory directory;
  write(directory / "small.toml", solid_shaft("tolerance = \"20 %\""));
  ASSERT_EQ(millstress(directory.path, "run small.toml -o out").exit_code, 0);
  const auto first = contents(directory / "out");
  fs::remove(directory / "out/run.json");  // else nothing is computed
  const auto run = millstress(directory.path, "run small.toml -o out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("responses of an earlier run"), std::string::npos) << run.out;
  EXPECT_EQ(contents(directory / "out"), first);
}

// Instants that a search adds have the body superposed once more in the end. What is told of a damaged file
// is what its own steps met.
TEST(Tolerance, WhatASearchMetIsToldAfterMoreInstants) {
  const results_test::Directory directory;
  write(directory / "small.toml",
        small_shaft({{"pull", "middle.fy", "100 N", 3}, {"pull", "middle.fx", "200 N", 6, "45 deg"}}, "mm",
                    "600 rpm", ""));
  const auto run = [&] {
    return millstress(directory.path, "run small.toml -o solid --tolerance '10 %' --method solid");
  };
  ASSERT_EQ(run().exit_code, 0);
  ASSERT_GT(summary(directory / "solid")["input"]["instants_per_turn"].get<int>(), 24)
      << "else there is no case";
  const auto kept = cached_responses(directory.path, "solid");
  auto bytes = results_test::bytes(kept);
  bytes[bytes.size() / 3] = char(bytes[bytes.size() / 3] ^ 1);
  write(kept, bytes);
  const auto again = run();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find(kept.filename().string() + ": is damaged"), std::string::npos) << again.err;
  EXPECT_NE(summary(directory / "solid")["warnings"].dump().find("is damaged"), std::string::npos);
}

// "1.3e+02 %" is no way to say that nothing is known.
TEST(Tolerance, AnErrorBeyondTheStressIsWrittenOut) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", ""));
  std::string bores;
  for (const char* segment : {"1", "2", "3", "4", "5"})
    bores += std::string(" --set 'shaft.contour[") + segment + "].bore=9.7 mm'";
  const auto outcome = as_a_user(directory.path, "run scene.toml --method beam -o out" + bores);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = summary(directory / "out");
  const auto& stress = shaft_of(results)["governing"];
  const double share = stress["error"]["total"].get<double>() / stress["value"].get<double>();
  ASSERT_GT(share, 1) << "else this test has no case";
  const auto text = "is known to " + std::to_string(std::lround(100 * share)) + " % only";
  EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
}

// "none" in the scene or on the command line: solved once on the scene's mesh, whatever the default is.
TEST(Tolerance, NoneSolvesOnceOnTheScenesMesh) {
  const results_test::Directory directory;
  write(directory / "none.toml", solid_shaft("tolerance = \"none\""));
  write(directory / "five.toml", solid_shaft("tolerance = \"5 %\""));
  ASSERT_EQ(millstress(directory.path, "run none.toml -o scene").exit_code, 0);
  ASSERT_EQ(millstress(directory.path, "run five.toml --tolerance none -o command").exit_code, 0);
  for (const char* out : {"scene", "command"})
    EXPECT_FALSE(summary(directory / out)["bodies"]["shaft"].contains("search")) << out;
  EXPECT_EQ(summary(directory / "scene")["bodies"]["shaft"]["peak_von_mises"],
            summary(directory / "command")["bodies"]["shaft"]["peak_von_mises"]);
}

TEST(Tolerance, WrongRequestsAreRefused) {
  const results_test::Directory directory;
  write(directory / "small.toml", solid_shaft());
  write(directory / "wrong.toml", solid_shaft("tolerance = \"2 mm\""));
  for (const std::string arguments : {"run small.toml --tolerance soon", "run small.toml --tolerance '200 %'",
                                      "run small.toml --time-limit '3 kg'", "run wrong.toml"}) {
    const auto run = millstress(directory.path, arguments + " -o out");
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(arguments == "run wrong.toml" ? "tolerance" : "--t"), std::string::npos)
        << run.err;
    EXPECT_FALSE(fs::exists(directory / "out")) << arguments;
  }
}
