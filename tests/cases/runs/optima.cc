// Optima: found as a sweep of the whole box finds them, with the errors that a run states, at a tenth of the
// solves.
#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"
#include "tests/cases/program/swept_points.h"

#include <algorithm>
#include <cmath>

using namespace cases;

namespace {

const std::string diameters =
    "shaft.contour[1].diameter, shaft.contour[2].diameter, shaft.contour[3].diameter, "
    "shaft.contour[4].diameter, shaft.contour[5].diameter";
const std::string bores =
    "shaft.contour[1].bore, shaft.contour[2].bore, shaft.contour[3].bore, shaft.contour[4].bore, "
    "shaft.contour[5].bore";

/// A pull in the middle of the bar, by the beam: thousandths of a second a point.
std::string pulled_bar(const std::string& keys = "fatigue = \"off\"") {
  return "method = \"beam\"\n" +
         small_shaft(fixed_in_space("pull", "middle", "200 N"), "mm", "600 rpm", keys);
}

std::string request(const std::string& scene, const std::string& bound) {
  return "optimise " + scene + " --minimise bodies.shaft.mass --keep '" + bound + "' --vary '" + diameters +
         " = 11..13 mm' --vary '" + bores + " = 2..8 mm'";
}

}  // namespace

// Turns red: the search ends early, a bound counts without its error, or keys that go together do not.
TEST(Optima, OfTwoKeysAreThoseOfASweepOfTheBox) {
  const results_test::Directory directory;
  write(directory / "bar.toml", pulled_bar());
  const double wanted = 1.5;
  const auto found =
      json_of(directory.path, request("bar.toml", "bodies.shaft.governing.safety >= 1.5") + " --json");
  ASSERT_TRUE(found["is_kept"].get<bool>()) << found;
  EXPECT_TRUE(found["has_converged"].get<bool>());
  const auto points =
      points_of(directory.path, "bar.toml -o swept --figure bodies.shaft.margin.yield --vary '" + diameters +
                                    " = 11..13 mm / 25' --vary '" + bores + " = 2..8 mm / 25'");
  double least_kg = INFINITY;
  for (const auto& point : points) {
    const double safety = figure(point, "bodies.shaft.governing.safety");
    const double error = figure(point, "bodies.shaft.governing.safety.error");
    if (safety - error >= wanted) least_kg = std::min(least_kg, figure(point, "bodies.shaft.mass"));
  }
  const auto& figures = found["figures"];
  const double mass_kg = figures["bodies.shaft.mass"]["value"];
  const auto& safety = figures["bodies.shaft.governing.safety"];
  EXPECT_GE(safety["value"].get<double>() - safety["error"].get<double>(), wanted);
  // The grid's own points are up to half a step of 0.25 mm of the bore from the optimum: 1 % of the mass.
  EXPECT_LE(mass_kg, 1.002 * least_kg);
  EXPECT_GE(mass_kg, 0.97 * least_kg);
  EXPECT_LE(found["evaluations"].get<std::size_t>(), points.size() / 10);
}

// The scene that it leaves, run by itself, has the figures of the optimum to the last digits.
// Turns red: a key is not in it, or an error of the run is not the one that the bound was kept with.
TEST(Optima, StandInASceneThatRuns) {
  const results_test::Directory directory;
  write(directory / "bar.toml", pulled_bar());
  const auto found = json_of(directory.path,
                             request("bar.toml", "bodies.shaft.governing.safety >= 1.5") + " -o best --json");
  const auto run = as_a_user(directory.path, "run best/optimum.toml -o alone");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto body = summary(directory / "alone")["bodies"]["shaft"];
  const auto same = [&](const std::string& name, double value) {
    const double own = found["figures"]["bodies.shaft." + name]["value"];
    EXPECT_NEAR(own, value, 1e-10 * value) << name;
  };
  same("mass", body["mass"]["value"]);
  same("governing.safety", body["governing"]["safety_against_yield"]);
  const double stress = body["governing"]["value"], error = body["governing"]["error"]["total"];
  const auto& safety = found["figures"]["bodies.shaft.governing.safety"];
  EXPECT_NEAR(safety["error"].get<double>() / safety["value"].get<double>(), error / (stress + error), 1e-10);
}

// Turns red: a part of the journal does not count, or a point depends on those before it.
TEST(Optima, HaveOnePathAndGoOn) {
  const results_test::Directory directory;
  write(directory / "bar.toml", pulled_bar());
  const auto asked = request("bar.toml", "bodies.shaft.governing.safety >= 1.5");
  const auto optimise = [&](const std::string& options, bool is_known) {
    const auto outcome = as_a_user(directory.path, asked + " -o best " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("point 1:") == std::string::npos, is_known) << outcome.err;
    return results_test::bytes(directory / "best/optimum.csv");
  };
  const auto path = optimise("", false);
  auto journal = results_test::bytes(directory / "best/journal");
  EXPECT_EQ(optimise("--fresh", false), path);
  journal.resize(journal.size() / 2);
  write(directory / "best/journal", journal);
  EXPECT_EQ(optimise("", true), path);
}

TEST(Optima, ThatCannotBeSayWhatCanBeKept) {
  const results_test::Directory directory;
  write(directory / "bar.toml", pulled_bar());
  const auto outcome =
      as_a_user(directory.path, request("bar.toml", "bodies.shaft.governing.safety >= 50") + " -o none");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("--keep bodies.shaft.governing.safety >= 50: none of "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("can be kept, at"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(directory / "none/optimum.csv"));
  EXPECT_FALSE(fs::exists(directory / "none/optimum.toml"));
}

TEST(Optima, RefuseWhatIsWrongAtOnce) {
  const results_test::Directory directory;
  write(directory / "bar.toml", pulled_bar());
  const std::string vary = " --vary 'shaft.contour[1].diameter = 8..20 mm'",
                    mass = " --minimise bodies.shaft.mass";
  for (const auto& [arguments, said] :
       {std::pair<std::string, std::string>{vary, "--minimise FIGURE or --maximise FIGURE"},
        {mass, "nothing is varied"},
        {" --minimise bodies.shaft.mas" + vary, "did you mean \"bodies.shaft.mass\"?"},
        {mass + vary + " --keep 'bodies.shaft.governing <= 100 mm'",
         "--keep bodies.shaft.governing <= 100 mm"},
        {mass + vary + " --keep 'bodies.shaft.governing'", "is no bound"},
        {mass + " --vary 'shaft.contour[1].diametr = 8..20 mm'", "did you mean \"diameter\"?"},
        {mass + " --vary 'shaft.contour[1].diameter = 8..20 s'", "diameter"}}) {
    const auto outcome = as_a_user(directory.path, "optimise bar.toml -o none" + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << arguments << outcome.err;
    EXPECT_FALSE(fs::exists(directory / "none/optimum.csv")) << arguments;
  }
}

// A sweep of two points of a spring shows which way the bearing's load falls. Turns red: --loads solves a
// body, or a range that ends at the optimum is not told.
TEST(Optima, OfLoadsSolveNothing) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const std::string springs = "machine.springs[1].stiffness[2], machine.springs[2].stiffness[2]";
  const auto found = json_of(directory.path, "optimise mill.toml --loads --minimise loads.R_E.max --vary '" +
                                                 springs + " = 20..35 kN/m' --json");
  const auto ends = points_of(directory.path, "mill.toml --loads --vary '" + springs + " = 20, 35 kN/m'");
  const double low = figure(ends[0], "loads.R_E.max"), high = figure(ends[1], "loads.R_E.max");
  EXPECT_LE(found["figures"]["loads.R_E.max"]["value"].get<double>(), std::min(low, high));
  EXPECT_TRUE(found["keys"][springs]["limits"].get<bool>()) << found;
}

// Turns red: fatigue of a point is not that of a run, or its error is another one.
TEST(Optima, AndSweepsHaveTheFatigueOfARun) {
  const results_test::Directory directory;
  write(directory / "bar.toml",
        "method = \"axisymmetric\"\n" +
            small_shaft(fixed_in_space("pull", "middle", "200 N"), "mm", "600 rpm", "") +
            "[shaft.fatigue]\ntensile_strength = \"600 MPa\"\nroughness = \"1 um\"\n");
  const auto points = points_of(directory.path,
                                "bar.toml --tolerance none --figure bodies.shaft.fatigue.safety --vary "
                                "'machine.speed = 600, 700 rpm'");
  ASSERT_EQ(points.size(), 2u);
  const auto run = millstress(directory.path, "run bar.toml -o alone --set 'machine.speed=700 rpm'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto place = summary(directory / "alone")["bodies"]["shaft"]["fatigue"]["places"][0];
  const double safety = place["safety_against_endurance"], least = place["safety_least"];
  EXPECT_NEAR(figure(points[1], "bodies.shaft.fatigue.safety"), safety, 1e-10 * safety);
  EXPECT_NEAR(figure(points[1], "bodies.shaft.fatigue.safety.error"), safety - least, 1e-10 * safety);
}
