// Sweeps: every point is what a run by itself says, whatever is shared between points.
#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"
#include "tests/cases/program/swept_points.h"

#include <sys/resource.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

using namespace cases;

namespace {

/// The run of a point alone, on the same mesh.
nlohmann::json alone(const fs::path& directory, const std::string& scene, const nlohmann::json& point) {
  std::string arguments = "run " + scene + " --force -o alone";
  for (const auto& [key, value] : point["keys"].items())
    if (value != "kept") arguments += " --set '" + key + "=" + value.get<std::string>() + "'";
  const auto outcome = millstress(directory, arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return summary(directory / "alone");
}

/// Sums over the channels in another order: rounding of some thirty terms that partly cancel.
constexpr double same = 1e-10;

void expect_same(const nlohmann::json& point, const nlohmann::json& run, const std::string& body) {
  const auto& wanted = run["bodies"][body];
  const auto near = [&](const std::string& name, double value) {
    EXPECT_NEAR(figure(point, name), value, same * std::abs(value)) << name << point["keys"];
  };
  near("bodies." + body + ".governing", wanted["governing"]["value"]);
  near("bodies." + body + ".peak_von_mises", wanted["peak_von_mises"]["value"]);
  if (wanted.contains("torsion")) {
    const std::string name = "bodies." + body + ".torsion.max_shear_stress";
    near(name, wanted["torsion"]["max_shear_stress"]["value"]);
    const double error_Pa = wanted["torsion"]["max_shear_stress"]["error"];
    EXPECT_GT(error_Pa, 0);
    EXPECT_NEAR(figure(point, name + ".error"), error_Pa, 1e-6 * error_Pa);
  }
  near("bodies." + body + ".governing.safety", wanted["governing"]["safety_against_yield"]);
  EXPECT_EQ(point["texts"]["bodies." + body + ".governing.place"], wanted["governing"]["feature"]);
  // A single mesh states the same error of itself in both.
  const double error = wanted["governing"]["error"]["numerical"];
  EXPECT_NEAR(figure(point, "bodies." + body + ".governing.error"), error, 1e-6 * error);
  for (const auto& [name, values] : run["loads"].items()) near("loads." + name + ".max", values["max"]);
}

/// The columns of a file without quotes, by title.
std::map<std::string, std::vector<std::string>> table_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::vector<std::vector<std::string>> lines;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    lines.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) lines.back().push_back(cell);
  }
  std::map<std::string, std::vector<std::string>> table;
  for (std::size_t c = 0; !lines.empty() && c < lines.front().size(); ++c) {
    auto& column = table[lines.front()[c]];
    for (std::size_t i = 1; i < lines.size(); ++i) column.push_back(lines[i].at(c));
  }
  return table;
}

}  // namespace

TEST(Sweeps, PointsOfAShaftAreRunsByThemselves) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const auto points =
      points_of(directory.path,
                "mill.toml --tolerance none --vary 'machine.drive.speed = 1350..1600 rpm' "
                "--vary 'machine.charge.mass = 16..20 kg' --design latin-hypercube --points 2");
  ASSERT_EQ(points.size(), 2u);
  for (const auto& point : points) expect_same(point, alone(directory.path, "mill.toml", point), "shaft");
}

// With the responses of all six kept it would be 1.3 times as much.
TEST(Sweeps, OfManyDesignsTakeTheMemoryOfFew) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const auto peak_kilobytes = [&](int n_designs) {
    const auto points = points_of(
        directory.path, "mill.toml --tolerance none --fresh --vary 'shaft.contour[1].length = 40..60 mm / " +
                            std::to_string(n_designs) + "'");
    EXPECT_EQ(points.size(), std::size_t(n_designs));
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    return double(children.ru_maxrss);  // of the largest so far
  };
  const double of_two = peak_kilobytes(2), of_six = peak_kilobytes(6);
  EXPECT_LT(of_six, 1.15 * of_two);  // meshes of other lengths differ
}

// A beam writes no mesh, and a sweep no results of its points.
TEST(Sweeps, OfBeamsLeaveNoEmptyFolder) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", ""));
  points_of(directory.path, "scene.toml -o out --set method=beam --vary 'machine.speed = 600..700 rpm / 3'");
  ASSERT_TRUE(fs::exists(directory / "out/sweep.csv"));
  for (const auto& entry : fs::recursive_directory_iterator(directory / "out"))
    EXPECT_FALSE(entry.is_directory() && fs::is_empty(entry.path())) << entry.path();
}

// Open MPI's libraries were unloaded, with threads of the solvers alive, before those that draw were loaded:
// one sweep ended by a segmentation fault there, which no other command ever did.
TEST(Sweeps, DrawBeforeTheLibrariesOfSolversGo) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", ""));
  const auto outcome = as_a_user(
      directory.path, "sweep scene.toml -o out --set method=beam --vary 'machine.speed = 600, 700 rpm'",
      "export LD_DEBUG=files LD_DEBUG_OUTPUT=loaded");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_TRUE(fs::exists(directory / "out/chart.png"));
  std::size_t n_processes = 0;
  bool has_components = false;
  for (const auto& entry : fs::directory_iterator(directory.path)) {
    if (entry.path().filename().string().rfind("loaded.", 0) != 0) continue;
    const auto log = results_test::bytes(entry.path());
    has_components = has_components || log.find("mca_pml_") != std::string::npos;
    const auto last = [&](const std::string& event, const std::string& library) {
      std::size_t found = std::string::npos;
      for (auto line = log.find(event); line != std::string::npos; line = log.find(event, line + 1))
        if (log.substr(line, log.find('\n', line) - line).find(library) != std::string::npos) found = line;
      return found;
    };
    const auto draws = last("calling init: ", "libEGL"), ends = last("calling fini: ", "mca_pml_");
    if (draws == std::string::npos || ends == std::string::npos) continue;
    ++n_processes;
    EXPECT_LT(draws, ends);
  }
  if (!has_components) GTEST_SKIP() << "skipped: this Open MPI has its components inside, and unloads none";
  EXPECT_EQ(n_processes, 1u);
}

// A model is searched by itself: one row must not have another one's stress under its own name.
TEST(Sweeps, AModelIsAValueLikeAnyOther) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", ""));
  const std::string vary = "scene.toml --vary 'method = ";
  const auto points = points_of(directory.path, vary + "beam, axisymmetric'");
  ASSERT_EQ(points.size(), 2);
  const auto reversed = points_of(directory.path, vary + "axisymmetric, beam' --fresh");
  for (const char* name : {"bodies.shaft.governing", "bodies.shaft.governing.error"}) {
    EXPECT_NE(figure(points[0], name), figure(points[1], name)) << name;
    EXPECT_DOUBLE_EQ(figure(points[0], name), figure(reversed[1], name)) << name;
    EXPECT_DOUBLE_EQ(figure(points[1], name), figure(reversed[0], name)) << name;
  }
}

// An effect that is off has no channels, so that another set of unit loads would be solved; other sectors are
// another mesh; the yield strength is no part of either. A mesh takes no more instants to another point than
// its search asked for beyond the scene's.
TEST(Sweeps, EffectsMaterialsAndMeshesAreValuesLikeAnyOther) {
  const results_test::Directory directory;
  // Sweeps look for crests between the instants at the point that governs alone; of so many, runs do, too.
  write(directory / "mill.toml",
        with_edits(shaft_alone(coarse()), {{"instants_per_turn = 24", "instants_per_turn = 96"}}));
  for (const char* vary : {"effects.charge_lag = on, off' --vary 'shaft.material.yield_strength = 250 MPa",
                           "shaft.mesh.sectors = 8, 12", "sampling.instants_per_turn = 100, 96"}) {
    const auto points = points_of(
        directory.path, std::string("mill.toml --tolerance none --force -o swept --vary '") + vary + "'");
    ASSERT_EQ(points.size(), 2u) << vary;
    for (const auto& point : points) expect_same(point, alone(directory.path, "mill.toml", point), "shaft");
  }
}

// Whatever the scene or the command line says of effects, single ones can be switched; what the program would
// choose is all on, since it could choose otherwise at every point.
TEST(Sweeps, NameTheEffectsOfEveryPoint) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  for (const char* effects : {"", "--set effects=all", "--set 'effects = auto'"}) {
    std::string err;
    const auto points =
        points_of(directory.path,
                  std::string("mill.toml --loads --vary 'effects.charge_lag = on, off' ") + effects, &err);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_GT(figure(points[0], "loads.charge_power.max"), 0) << effects;
    EXPECT_EQ(err.find("chooses by the point") != std::string::npos,
              std::string(effects).find("auto") != std::string::npos);
    EXPECT_NE(points[0]["figures"], points[1]["figures"]) << effects;
  }
}

TEST(Sweeps, ASpringMayBeTakenAway) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const auto points =
      points_of(directory.path, "mill.toml --loads --vary 'machine.springs[2] = kept, removed'");
  ASSERT_EQ(points.size(), 2u);
  const auto outcome = as_a_user(directory.path, "loads mill.toml --json --set 'machine.springs[2]=removed'");
  if (outcome.exit_code != 0) {
    EXPECT_FALSE(points[1].value("refused", "").empty());
    return;
  }
  const auto loads = nlohmann::json::parse(outcome.out)["loads"];
  for (const auto& [name, values] : loads.items())
    EXPECT_EQ(figure(points[1], "loads." + name + ".max"), values["max"].get<double>()) << name;
}

TEST(Sweeps, TellKeysThatChangeNothing) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const std::string told = "no figure of this sweep changes with ";
  const auto said = [&](const std::string& vary) {
    const auto outcome = as_a_user(directory.path, "sweep mill.toml --loads --fresh" + vary);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  const std::string speed = " --vary 'machine.drive.speed = 1400, 1500 rpm'",
                    strength = " --vary 'shaft.material.yield_strength = 200, 300 MPa'";
  const auto both = said(speed + strength);
  EXPECT_NE(both.find(told + "shaft.material.yield_strength; stresses may"), std::string::npos) << both;
  EXPECT_EQ(both.find(told + "machine.drive.speed"), std::string::npos) << both;
}

// A train has no force.
TEST(Sweeps, OfATrainShowItsTorques) {
  const results_test::Directory directory;
  write(directory / "train.toml", edited("drive_train.toml", {}));
  const auto outcome = as_a_user(
      directory.path, "sweep train.toml --vary 'machine.excitations[1].harmonics[1].frequency = 40, 50 Hz'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("loads.working_shaft_1.torque.max [N m]"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.err.find("no figure"), std::string::npos) << outcome.err;
}

// 34 turns of 1360 rpm are 75 periods of 50 Hz; of 1350 rpm they are 75.6, and extremes and means are those
// of the window. Red if a sweep says nothing of what `loads` warns of.
TEST(Sweeps, CountTheWarningsOfEachPoint) {
  const results_test::Directory directory;
  const auto sweep = [&](const std::string& options) {
    const auto outcome = millstress(
        directory.path, "sweep '" + shipped("drive_train.toml").string() +
                            "' --vary 'machine.reference.speed = 1360, 1350 rpm' -o out" + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const auto points = nlohmann::json::parse(sweep(" --json"))["points"];
  ASSERT_EQ(points.size(), 2u);
  EXPECT_FALSE(points[0]["figures"].contains("loads.warnings")) << points[0]["figures"]["loads.warnings"];
  EXPECT_EQ(figure(points[1], "loads.warnings"), 1);
  EXPECT_NE(sweep("").find("1 of 2 points have warnings"), std::string::npos);
}

// A column of errors stands behind the figures that have one, and behind no others.
TEST(Sweeps, PrintErrorsBesideTheirFigures) {
  const results_test::Directory directory;
  write(directory / "shaft.toml", small_shaft({{"pull", "middle.fy", "1 kN"}}));
  const auto outcome = as_a_user(directory.path,
                                 "sweep shaft.toml -o swept -q --vary 'machine.speed = 600, 700 rpm' "
                                 "--figure bodies.shaft.governing --figure bodies.shaft.governing.safety");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string title, first;
  std::getline(lines, title);
  std::getline(lines, first);
  EXPECT_TRUE(
      std::regex_search(title, std::regex(R"(governing \[MPa\] +\+- +bodies\.shaft\.governing\.safety$)")))
      << title;
  EXPECT_EQ(first.find("nan"), std::string::npos) << first;
}

// The eccentric shaft as a body of revolution: 0.4 MPa by its mesh, 9 MPa since eccentric segments are taken
// as concentric. Sweeps, zones and places state both.
TEST(Sweeps, ErrorsOfCheapModelsHoldTheModels) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone({{"instants_per_turn = 120", "instants_per_turn = 24"},
                                              {"pictures = true", "pictures = false"}}));
  const std::string arguments = "mill.toml --set method=axisymmetric --tolerance '15 %'";
  const auto points =
      points_of(directory.path, arguments + " --zones -o swept --vary 'machine.drive.speed = 1350 rpm'");
  const auto outcome =
      millstress(directory.path, "run " + arguments + " -o alone --set 'machine.drive.speed=1350 rpm'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto run = summary(directory / "alone");
  const auto& error = run["bodies"]["shaft"]["governing"]["error"];
  double wanted_Pa = error["numerical"];
  for (const char* source : {"eccentric_segments", "offset_axis", "ovalisation", "spin"})
    wanted_Pa += error.value(source, 0.0);
  EXPECT_GT(wanted_Pa, 5 * error["numerical"].get<double>());
  EXPECT_NEAR(figure(points[0], "bodies.shaft.governing.error"), wanted_Pa, 1e-6 * wanted_Pa);
  EXPECT_NEAR(figure(points[0], "bodies.shaft.zones[1].peak.error"), wanted_Pa, 1e-6 * wanted_Pa);
  const auto& zones = run["bodies"]["shaft"]["zones"];
  EXPECT_NEAR(zones.at(0)["error_Pa"], wanted_Pa, 1e-6 * wanted_Pa);
  // Of others the model's share alone is as large as that of the peak.
  const double share =
      (wanted_Pa - error["numerical"].get<double>()) / zones[0]["peak_von_mises_Pa"].get<double>();
  for (const auto& place : run["bodies"]["shaft"]["places"])
    EXPECT_GE(place["error_Pa"].get<double>(), 0.999 * share * place["von_mises_Pa"].get<double>()) << place;
}

// A point's zones are those of its run alone; those that the journal knows follow as before.
TEST(Sweeps, FollowTheZonesOfTheirPoints) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const std::string arguments =
      "mill.toml --tolerance none --zones -o swept --vary 'machine.drive.speed = 1350..1600 rpm / 2'";
  const auto points = points_of(directory.path, arguments);
  const auto swept = table_of(directory / "swept/zones.csv");
  std::size_t row = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    (void)alone(directory.path, "mill.toml", points[p]);
    const auto wanted = table_of(directory / "alone/shaft/zones.csv");
    for (std::size_t z = 0; z < wanted.at("feature").size(); ++z, ++row) {
      ASSERT_LT(row, swept.at("point").size());
      EXPECT_EQ(swept.at("point")[row], std::to_string(p + 1));
      for (const char* name : {"feature", "place", "nodes"})
        EXPECT_EQ(swept.at(name)[row], wanted.at(name)[z]) << name;
      for (const char* name : {"peak_von_mises [MPa]", "x [mm]", "volume [mm3]"}) {
        const double value = std::stod(wanted.at(name)[z]);
        EXPECT_NEAR(std::stod(swept.at(name)[row]), value, same * std::abs(value)) << name;
      }
      const auto figure_name = "bodies.shaft.zones[" + swept.at("zone")[row] + "].peak";
      const double peak_Pa = figure(points[p], figure_name);
      EXPECT_NEAR(std::stod(swept.at("peak_von_mises [MPa]")[row]), peak_Pa / 1e6, 1e-20 * peak_Pa)
          << "fifteen digits";
    }
  }
  EXPECT_EQ(row, swept.at("point").size());
  EXPECT_GE(row, points.size());
  const auto table = results_test::bytes(directory / "swept/zones.csv");
  auto journal = results_test::bytes(directory / "swept/journal");
  journal.resize(journal.size() - 20);
  write(directory / "swept/journal", journal);
  std::string err;
  points_of(directory.path, arguments, &err);
  EXPECT_NE(err.find("1 known from"), std::string::npos) << err;
  EXPECT_EQ(results_test::bytes(directory / "swept/zones.csv"), table);
  auto without_zones = arguments;
  without_zones.erase(without_zones.find("--zones"), 7);
  points_of(directory.path, without_zones);
  EXPECT_FALSE(fs::exists(directory / "swept/zones.csv"));
}

// The first point loads the one end of the shaft, whose search refines the fillet there; the second the other
// end. What it states is then that of a search of its own.
TEST(Sweeps, SearchAMeshForPointsThatTheFirstKnowsLessWell) {
  const results_test::Directory directory;
  write(directory / "shaft.toml", R"(effects = ["left", "right"]
method = "solid"
[machine]
type = "load_table"
speed = "600 rpm"
[[machine.constants]]
effect = "left"
load = "thin.fy"
value = "300 N"
[[machine.constants]]
effect = "right"
load = "thick.fy"
value = "1 N"
[sampling]
instants_per_turn = 12
turns = 1
[shaft]
contour = [
  { port = "thin", diameter = "14 mm", length = "20 mm" },
  { fillet = "1 mm" },
  { port = "bearing_1", diameter = "20 mm", length = "14 mm" },
  { port = "bearing_2", diameter = "22 mm", length = "14 mm" },
  { fillet = "0.6 mm" },
  { port = "thick", diameter = "16 mm", length = "20 mm" },
]
bearings = ["bearing_1", "bearing_2"]
torque_support = "bearing_2"
[shaft.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
[results]
snapshots = 0
pictures = false
)");
  const std::string vary = " --vary 'machine.constants[2].value = 1, 900 N'",
                    searched_for = "bodies.shaft.mesh", governing = "bodies.shaft.governing";
  std::string err;
  const auto points = points_of(directory.path, "shaft.toml -o asked --tolerance '3 %'" + vary, &err);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NE(err.find("1 more mesh was searched"), std::string::npos) << err;
  EXPECT_EQ(err.find("searching takes"), std::string::npos) << "no limit was asked for: " << err;
  for (const auto& point : points) {
    EXPECT_LE(figure(point, governing + ".error"), 0.03 * figure(point, governing)) << point["keys"];
    EXPECT_NE(point["texts"][searched_for].get<std::string>().find(
                  point["keys"]["machine.constants[2].value"].get<std::string>()),
              std::string::npos)
        << point["texts"];
  }
  const auto alone = millstress(
      directory.path, "run shaft.toml -o alone --tolerance '3 %' --set 'machine.constants[2].value=900 N'");
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_NEAR(figure(points[1], governing),
              summary(directory / "alone")["bodies"]["shaft"]["governing"]["value"],
              same * figure(points[1], governing));
  // What a sweep that goes on has searched, it does not search again.
  const auto again = points_of(directory.path, "shaft.toml -o asked --tolerance '3 %'" + vary, &err);
  EXPECT_EQ(again, points);
  EXPECT_EQ(err.find("more mesh"), std::string::npos) << err;
}

// Half of the time of a sweep of a shaft with fatigue went into lives that it does not state.
TEST(Sweeps, JudgeNoFatigue) {
  const results_test::Directory directory;
  write(directory / "shaft.toml", small_shaft(fixed_in_space("pull", "middle", "100 N")) +
                                      "[shaft.fatigue]\ntensile_strength = \"590 MPa\"\n");
  std::string err;
  (void)points_of(directory.path, "shaft.toml -v --tolerance none --vary 'machine.speed = 500, 600 rpm'",
                  &err);
  EXPECT_NE(err.find("  zones "), std::string::npos) << err;
  EXPECT_EQ(err.find("  fatigue "), std::string::npos) << err;
}

// Operating blocks have no part in a sweep; settings of them are those of a run all the same.
TEST(Sweeps, TakeSettingsOfOperatingBlocks) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()) + "\n[[duty]]\nname = \"all\"\nshare = \"100 %\"\n");
  const std::string vary = "mill.toml --loads --vary 'machine.charge.mass = 10, 20 kg' ";
  const auto plain = points_of(directory.path, vary);
  ASSERT_EQ(plain.size(), 2u);
  for (const char* setting : {"duty=removed", "'duty[1].share=90 %'"}) {
    const auto set = points_of(directory.path, vary + "--set " + setting);
    ASSERT_EQ(set.size(), 2u) << setting;
    EXPECT_EQ(set[1]["figures"], plain[1]["figures"]) << setting;
  }
  const auto outcome = as_a_user(directory.path, "sweep " + vary + "--set 'duty[2].share=90 %'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
}

// The scene says what is drawn and printed; --figure goes first.
TEST(Sweeps, DrawWhatTheSceneNames) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()) +
                                     "\n[sweep]\nvary = [\"machine.charge.mass = 10..20 kg / 3\"]\n"
                                     "figures = [\"loads.R_E.max\", \"loads.R_E.mean\"]\n");
  const auto as_named = as_a_user(directory.path, "sweep mill.toml --loads -q -o swept");
  ASSERT_EQ(as_named.exit_code, 0) << as_named.err;
  EXPECT_NE(as_named.out.find("loads.R_E.mean"), std::string::npos) << as_named.out;
  EXPECT_TRUE(fs::exists(directory / "swept/chart.png"));
  const auto asked = as_a_user(directory.path, "sweep mill.toml --loads -q -o swept --figure loads.T.rms");
  ASSERT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_NE(asked.out.find("loads.T.rms"), std::string::npos);
  EXPECT_EQ(asked.out.find("loads.R_E"), std::string::npos);
}

TEST(Sweeps, MayStandInTheScene) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()) +
                                     "\n[sweep]\nvary = [\"machine.charge.mass = 10..20 kg\"]\n"
                                     "design = \"latin-hypercube\"\npoints = 5\n");
  EXPECT_EQ(points_of(directory.path, "mill.toml --loads").size(), 5u);
  EXPECT_EQ(as_a_user(directory.path, "check mill.toml").exit_code, 0);
  write(directory / "wrong.toml", shaft_alone(coarse()) + "\n[sweep]\nvary = [\"a = 1..2\"]\npoint = 5\n");
  const auto outcome = as_a_user(directory.path, "sweep wrong.toml --loads");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("did you mean \"points\""), std::string::npos) << outcome.err;
}
