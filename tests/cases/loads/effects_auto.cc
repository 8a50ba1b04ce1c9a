#include <algorithm>
#include <cmath>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// The scene with another value of `effects`.
std::string with_effects(std::string text, const std::string& value) {
  const auto begin = text.find("effects = ["), end = text.find(']', begin);
  if (begin == std::string::npos || end == std::string::npos) throw std::runtime_error("no list of effects");
  return text.replace(begin, end + 1 - begin, "effects = " + value);
}

const Edits quiet{{"snapshots = 12", "snapshots = 0"}, {"pictures = true", "pictures = false"}};
const Edits coarse_shaft{{"cells_per_fillet_quarter = 8", "cells_per_fillet_quarter = 2"},
                         {"sectors = 16", "sectors = 8"},
                         {"instants_per_turn = 120", "instants_per_turn = 24"}};
const Edits small_chamber{{"cells_through_wall = 2", "cells_through_wall = 1"},
                          {"# size = \"20 mm\"", "size = \"40 mm\" #"},
                          {"instants_per_turn = 120", "instants_per_turn = 24"}};
const Edits small_drum{{"cells_per_fillet_quarter = 6", "cells_per_fillet_quarter = 2"},
                       {"sectors = 24", "sectors = 12"},
                       {"instants_per_turn = 360", "instants_per_turn = 72"}};

nlohmann::json run(const fs::path& directory, const std::string& scene, const std::string& options,
                   std::string* out = nullptr) {
  write(directory / "scene.toml", scene);
  const auto outcome = millstress(directory, "run scene.toml -o out " + options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  if (out != nullptr) *out = outcome.out;
  return outcome.exit_code == 0 ? summary(directory / "out") : nlohmann::json();
}

std::set<std::string> set_of_names(const nlohmann::json& list) {
  return {list.begin(), list.end()};
}

std::set<std::string> dropped(const nlohmann::json& json) {
  std::set<std::string> result;
  for (const auto& [effect, figures] : json["dropped_effects"]["effects"].items()) result.insert(effect);
  return result;
}

/// The stress that the tolerance refers to, with its budget.
nlohmann::json governing(const nlohmann::json& json, const std::string& body) {
  const auto& solved = json["bodies"][body];
  if (!solved.contains("hot_spots")) return solved["peak_von_mises"];
  return {{"value", solved["hot_spots"][0]["von_mises_Pa"]}, {"error", solved["hot_spots"][0]["error"]}};
}

/// Runs a scene with all of its effects and with those that matter, with nothing else different.
struct Pair {
  nlohmann::json all, chosen;
};

Pair run_both(const std::string& scene, const std::string& options) {
  const results_test::Directory directory;
  return {run(directory.path, with_effects(scene, "\"all\""), options),
          run(directory.path, with_effects(scene, "\"auto\""), options)};
}

/// What is off would not have mattered: the stress with it lies within the bound that was listed, and that is
/// within a tenth of the tolerance. Rounding of the solves: 1e-9 of the stress.
void expect_within_the_bound(const Pair& runs, const std::string& body, double tolerance) {
  ASSERT_FALSE(runs.all.is_null() || runs.chosen.is_null());
  const auto with = governing(runs.all, body), without = governing(runs.chosen, body);
  const double stress = without["value"].get<double>();
  const double change = std::abs(with["value"].get<double>() - stress);
  const auto& choice = runs.chosen["dropped_effects"];
  ASSERT_FALSE(dropped(runs.chosen).empty());
  EXPECT_NEAR(choice["limit"].get<double>(), 0.1 * tolerance, 1e-15);
  EXPECT_LT(choice["share_of_loads"].get<double>(), 0.1 * tolerance);
  const double bound = choice["bodies"][body]["bound_Pa"].get<double>();
  EXPECT_LE(change, bound + 1e-9 * stress);
  EXPECT_LE(bound, 0.1 * tolerance * stress);
  EXPECT_LT(change, 0.1 * tolerance * stress);
  EXPECT_EQ(without["error"]["dropped_effects"].get<double>(), bound);
  EXPECT_FALSE(with["error"].contains("dropped_effects"));
  EXPECT_FALSE(runs.all.contains("dropped_effects"));
  for (const auto& effect : dropped(runs.chosen)) {
    const double alone = choice["effects"][effect]["bodies"][body]["bound_Pa"].get<double>();
    EXPECT_GE(alone, 0) << effect;
    EXPECT_LE(alone, 0.1 * tolerance * stress) << effect;
    EXPECT_EQ(set_of_names(runs.chosen["input"]["effects"]).count(effect), 0u) << effect;
  }
}

}  // namespace

// By itself: 5 % is taken for a tolerance. The weights that the springs carry at rest do not reach the shaft
// at all, that of the charge by 0.3 %.
TEST(EffectsAuto, WhatDoesNotReachTheShaftIsOff) {
  const auto runs = run_both(shaft_alone(coarse_shaft + quiet), "");
  expect_within_the_bound(runs, "shaft", 0.05);
  EXPECT_EQ(dropped(runs.chosen),
            (std::set<std::string>{"gravity_structure", "gravity_exciter", "gravity_charge"}));
  // The springs feel it, and it is said how much.
  const auto& change = runs.chosen["dropped_effects"]["load_change"];
  EXPECT_EQ(change["load"].get<std::string>().rfind("spring_foot_", 0), 0u);
  EXPECT_GT(change["share"].get<double>(), 0.1);
}

// A loose tolerance, met by the first mesh: effects go that the shaft feels. Their channels are not solved; a
// scene that names what is left gives the same numbers to the last bit.
TEST(EffectsAuto, WhatIsOffIsNotSolved) {
  const std::string scene = shaft_alone(coarse_shaft + quiet);
  const auto runs = run_both(scene, "--method axisymmetric --tolerance '50 %'");
  expect_within_the_bound(runs, "shaft", 0.5);
  const auto off = dropped(runs.chosen);
  EXPECT_EQ(off.count("gravity_shaft") + off.count("gravity_debalance"), 2u);
  const auto& all = runs.all["bodies"]["shaft"];
  const auto& chosen = runs.chosen["bodies"]["shaft"];
  auto missing = set_of_names(all["channels"]);
  for (const auto& channel : set_of_names(chosen["channels"]))
    EXPECT_EQ(missing.erase(channel), 1u) << channel;
  EXPECT_EQ(missing, (std::set<std::string>{"volume.ax", "volume.ay", "debalance_1.fy", "debalance_2.fy",
                                            "debalance_1.torque", "debalance_2.torque"}));
  // An acceleration of the whole shaft makes no stress; the debalance's couple was not solved, and is
  // estimated.
  const auto& bounds = runs.chosen["dropped_effects"]["effects"];
  EXPECT_EQ(bounds["gravity_shaft"]["bodies"]["shaft"]["estimated_Pa"].get<double>(), 0);
  EXPECT_GT(bounds["gravity_debalance"]["bodies"]["shaft"]["estimated_Pa"].get<double>(), 0);
  // It would have mattered a little: the comparison is not one of nothing with nothing.
  EXPECT_GT(std::abs(all["peak_von_mises"]["value"].get<double>() -
                     chosen["peak_von_mises"]["value"].get<double>()),
            1e-4 * chosen["peak_von_mises"]["value"].get<double>());

  const results_test::Directory directory;
  auto named = run(directory.path, with_effects(scene, runs.chosen["input"]["effects"].dump()),
                   "--method axisymmetric --tolerance '50 %'");
  ASSERT_FALSE(named.is_null());
  auto chosen_shaft = chosen;
  for (auto* shaft : {&named["bodies"]["shaft"], &chosen_shaft})
    for (auto& zone : (*shaft)["zones"])
      if (zone.contains("causes")) zone["causes"].erase("damage");  // states what was dropped in its error
  for (const char* quantity : {"channels", "peak_principal", "zones", "dofs", "torsion"})
    EXPECT_EQ(named["bodies"]["shaft"][quantity], chosen_shaft[quantity]) << quantity;
  EXPECT_EQ(named["bodies"]["shaft"]["peak_von_mises"]["value"], chosen["peak_von_mises"]["value"]);
  EXPECT_EQ(named["loads"], runs.chosen["loads"]);
}

// The loads let more go than the worst weld toe allows: one effect is taken back after the solve.
TEST(EffectsAuto, OnTheChamber) {
  const auto runs = run_both(chamber_alone(small_chamber + quiet), "--tolerance '50 %'");
  expect_within_the_bound(runs, "chamber", 0.5);
  const auto back = set_of_names(runs.chosen["dropped_effects"]["taken_back"]);
  EXPECT_FALSE(back.empty());
  for (const auto& effect : back) {
    EXPECT_EQ(set_of_names(runs.chosen["input"]["effects"]).count(effect), 1u) << effect;
    EXPECT_EQ(dropped(runs.chosen).count(effect), 0u) << effect;
  }
}

TEST(EffectsAuto, OnTheDrum) {
  const auto runs =
      run_both(edited("planetary_mill.toml", small_drum) + "[results]\nsnapshots = 0\npictures = false\n",
               "--method solid --tolerance '50 %'");
  expect_within_the_bound(runs, "drum", 0.5);
  EXPECT_EQ(dropped(runs.chosen).count("drum_gravity"), 1u);
}

// Histories of the user's own all count, however small.
TEST(EffectsAuto, LoadTablesKeepTheirHistories) {
  const results_test::Directory directory;
  const std::string scene =
      small_shaft({{"large", "middle.fy", "100 N"}, {"small", "middle.fy", "1 mN"}}, "mm", "600 rpm", "");
  std::string out;
  const auto named = run(directory.path, scene, ""),
             chosen = run(directory.path, with_effects(scene, "\"auto\""), "", &out);
  EXPECT_EQ(chosen["input"]["effects"], named["input"]["effects"]);
  EXPECT_TRUE(dropped(chosen).empty());
  EXPECT_NE(out.find("a load table's histories all count"), std::string::npos) << out;
}

// What goes is judged by the loads on the bodies, by every command.
TEST(EffectsAuto, CheckAndLoadsDropTheSame) {
  const results_test::Directory directory;
  const auto dropped_by = [&](const std::string& command) {
    const auto outcome = millstress(directory.path, command + " scene.toml");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto begin = outcome.out.find("  off by effects");
    if (begin == std::string::npos) return command + " says nothing: " + outcome.out;
    const auto end = std::min(outcome.out.find("\n\n", begin), outcome.out.find("\nwarning", begin));
    return outcome.out.substr(begin, outcome.out.find_last_not_of('\n', end) + 1 - begin);
  };
  const std::vector<std::pair<std::string, Edits>> scenes{
      {"root_peeler_shaft.toml",
       {{"cells_per_fillet_quarter = 4", "cells_per_fillet_quarter = 2\nsectors = 8"}}},
      {"planetary_mill.toml", small_drum},
      {"drive_train.toml", {}}};
  for (const auto& [name, edits] : scenes) {
    write(directory / "scene.toml", "tolerance = \"50 %\"\n" + with_effects(edited(name, edits), "\"auto\""));
    EXPECT_EQ(dropped_by("check"), dropped_by("loads")) << name;
  }
}

// Without a body every load counts, measured by itself.
TEST(EffectsAuto, TheLoadStageAloneJudgesByItsLoads) {
  const results_test::Directory directory;
  const std::string scene = edited("planetary_mill.toml", {});
  for (const bool loose : {false, true}) {
    std::string text = with_effects(scene.substr(0, scene.find("\n[drum]\n") + 1), "\"auto\"");
    if (loose) text = "tolerance = \"20 %\"\n" + text;
    write(directory / "loads.toml", text);
    const auto outcome = millstress(directory.path, "loads loads.toml --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    // Gravity changes the load of the drum by 1.2 %: below a tenth of 20 %, above that of 5 %.
    EXPECT_EQ(dropped(json).count("drum_gravity"), loose ? 1u : 0u);
    EXPECT_EQ(set_of_names(json["input"]["effects"]).count("drum_gravity"), loose ? 0u : 1u);
  }
}
