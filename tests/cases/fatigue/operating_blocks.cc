// [[duty]] as `millstress run` states it: damage, lives and bearing lives add up by shares, starts are cycles
// from rest, and blocks that change a body are refused.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>

#include "tests/cases/program/field_tables.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

/// S-N slope of steel, one cycle a turn at 600 rpm.
constexpr double slope = 5, turns_per_hour = 36000;

const std::string fatigue = "[shaft.fatigue]\ntensile_strength = \"600 MPa\"\nroughness = \"1 um\"\n";
const std::string bearing =
    "[[bearings]]\nname = \"left\"\nload = \"bearing_1\"\ndynamic_rating = \"5 kN\"\nelement = \"ball\"\n";

/// A force that stands still in space, on the shaft that is solved once on its own mesh.
std::string turning_shaft(const std::string& force, const std::string& keys) {
  return "method = \"solid\"\n" +
         small_shaft(fixed_in_space("pull", "middle", force), "mm", "600 rpm", "pressure_harmonics = 0") +
         keys;
}

std::string block(const std::string& name, const std::string& share, const std::string& keys = "") {
  return "[[duty]]\nname = \"" + name + "\"\nshare = \"" + share + "\"\n" + keys;
}

/// The block's force instead of the scene's.
std::string force(const std::string& size) {
  return "set.\"machine.harmonics[1].amplitude\" = \"" + size +
         "\"\nset.\"machine.harmonics[2].amplitude\" = \"" + size + "\"\n";
}

Json first_place(const Json& json) {
  return json["duty"]["places"]["shaft"][0];
}

Json run(const fs::path& directory, const std::string& scene) {
  return run_small(directory, scene);
}

}  // namespace

// A block that turns torsion's order from 1 to 9, or 20, at 24 instants: its damage is that many times that
// of the scene's own running. Turns red: blocks on the instants of the scene, which meet 9 periods in 24 and
// cannot tell 20 from 4. A block that gives its own instants has these, and is refused where they are too
// few.
TEST(OperatingBlocks, TakeTheInstantsThatTheirOrdersAskFor) {
  for (const int order : {9, 20}) {
    const results_test::Directory directory;
    const auto with = [&](const std::string& keys) {
      return "method = \"solid\"\ntolerance = \"none\"\n" +
             small_shaft({{"drive", "middle.torque", "45 N m", 1}}, "mm", "600 rpm",
                         "pressure_harmonics = 0") +
             fatigue +
             block("mesh", "100 %",
                   "set.\"machine.harmonics[1].order\" = " + std::to_string(order) + "\n" + keys);
    };
    if (order == 20) {
      write(directory / "scene.toml", with("set.sampling.instants_per_turn = 36\n"));
      const auto refused = millstress(directory.path, "check scene.toml");
      EXPECT_EQ(refused.exit_code, 2) << refused.out;
      EXPECT_NE(refused.err.find("take more than 40 instants per turn"), std::string::npos) << refused.err;
    }
    const auto json = run(directory.path, with(""));
    const auto own = json["bodies"]["shaft"]["fatigue"]["places"][0];
    ASSERT_FALSE(own["life_h"].is_null());
    const double life_h = own["life_h"], block_h = first_place(json)["life_h"];
    EXPECT_NEAR(block_h, life_h / order, 1e-5 * block_h) << "turning points to 1e-6, to the fifth power";
    const auto stress = json["duty"]["blocks"]["mesh"]["bodies"]["shaft"];
    EXPECT_LT(stress["time_sampling"]["value"].get<double>(),
              1e-9 * stress["von_mises"]["value"].get<double>());
  }
}

// Two blocks and standstill: each block does the damage that its force does alone, for its share of the
// operation. Lives alone are from runs without blocks.
TEST(OperatingBlocks, DamageAddsByShares) {
  const results_test::Directory directory;
  const auto alone = [&](const char* size) {
    return run(directory.path, turning_shaft(size, fatigue + bearing));
  };
  const auto light = alone("200 N"), heavy = alone("270 N");
  const auto both = run(directory.path, turning_shaft("200 N", fatigue + bearing + block("light", "50 %") +
                                                                   block("heavy", "25 %", force("270 N"))));
  const auto life = [](const Json& json) {
    return json["bodies"]["shaft"]["fatigue"]["places"][0]["life_h"].get<double>();
  };
  const double q_light = 2. / 3, q_heavy = 1. / 3;
  const double expected = 1 / (q_light / life(light) + q_heavy / life(heavy));
  const auto place = first_place(both);
  // The block's loads are the same numbers in another order: round-off of the stress, to the fifth power.
  EXPECT_NEAR(place["life_h"].get<double>(), expected, 1e-9 * expected);
  // Both blocks are above the knee, or count by its slope: life goes with the fifth power of stress.
  const double error = place["stress_error"];
  EXPECT_GT(error, 0);
  ASSERT_LT(error, 1);
  EXPECT_NEAR(place["life_range_h"][0].get<double>(), expected * std::pow(1 + error, -slope),
              1e-9 * expected);
  EXPECT_NEAR(place["life_range_h"][1].get<double>() / (expected * std::pow(1 - error, -slope)), 1, 1e-9);
  EXPECT_NEAR(place["life_days"].get<double>(), expected / 24 / 0.75, 1e-9 * expected);
  EXPECT_NEAR(place["by_block"]["heavy"]["damage_per_hour"].get<double>() * life(heavy), q_heavy, 1e-9);
  EXPECT_EQ(place["by_block"]["light"]["starts_damage_per_hour"].get<double>(), 0);
  ASSERT_EQ(both["warnings"].size(), 1u) << both["warnings"];
  EXPECT_NE(both["warnings"][0].get<std::string>().find("\"heavy\" stresses the shaft more than the scene's"),
            std::string::npos);
  // The scene's own results do not know of the blocks.
  EXPECT_EQ(both["bodies"]["shaft"]["fatigue"], light["bodies"]["shaft"]["fatigue"]);

  const auto hours = [](const Json& json) { return json["bearings"]["left"]["L10h"]["value"].get<double>(); };
  const double bearing_h = 1 / (q_light / hours(light) + q_heavy / hours(heavy));
  EXPECT_NEAR(both["duty"]["bearings"]["left"]["L10h"]["value"].get<double>(), bearing_h, 1e-9 * bearing_h);
  const double equivalent = std::cbrt(q_light * std::pow(100, 3) + q_heavy * std::pow(135, 3));
  EXPECT_NEAR(both["duty"]["bearings"]["left"]["equivalent_load"]["value"].get<double>(), equivalent,
              1e-6 * equivalent)
      << "half of the force, to what the mesh's ends leave";
  EXPECT_EQ(expect_fields_of_readme(directory / "out").count("duty.csv"), 1u);
  std::ifstream in(directory / "out/report.html");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(page.find("Operating blocks"), std::string::npos);
  EXPECT_NE(page.find("shaft: life over all blocks"), std::string::npos);
}

// Loads alone: bearings live over all blocks too. Turns red: blocks that are passed over in silence.
TEST(OperatingBlocks, BearingsOfASceneWithoutBodies) {
  const results_test::Directory directory;
  const auto lives = [&](const std::string& newton, const std::string& blocks) {
    write(directory / "scene.toml",
          "effects = [\"pull\"]\n[machine]\ntype = \"load_table\"\nspeed = \"600 rpm\"\n"
          "constants = [{ effect = \"pull\", load = \"seat.fx\", value = " +
              newton +
              " }]\n[[bearings]]\nname = \"left\"\nload = \"seat\"\ndynamic_rating = \"5 kN\"\n"
              "element = \"ball\"\n" +
              blocks);
    const auto outcome = millstress(directory.path, "run scene.toml -o out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return std::pair{summary(directory / "out"), outcome.out};
  };
  const auto hours = [](const Json& json) { return json["bearings"]["left"]["L10h"]["value"].get<double>(); };
  const double light = hours(lives("200", "").first), heavy = hours(lives("540", "").first);
  const auto [both, table] =
      lives("200", block("light", "50 %") +
                       block("heavy", "25 %", "set.\"machine.constants[1].value\" = \"540 N\"\n"));
  EXPECT_EQ(hours(both), light);
  ASSERT_TRUE(both.contains("duty"));
  const double expected = 1 / (2. / 3 / light + 1. / 3 / heavy);
  EXPECT_NEAR(hours(both["duty"]), expected, 1e-9 * expected);
  EXPECT_NE(table.find("bearings over all blocks"), std::string::npos) << table;
  EXPECT_FALSE(fs::exists(directory / "out/duty.csv"));
  const auto check = millstress(directory.path, "check scene.toml");
  EXPECT_NE(check.out.find("block heavy: 25 % of the time"), std::string::npos) << check.out << check.err;
}

// 100 N are below the limit and endure alone. Beside a block above it, Miner's elementary rule counts them by
// the same slope: N = N_D (limit / amplitude)^5.
TEST(OperatingBlocks, ABlockBelowTheLimitCountsBesideOneAboveIt) {
  const results_test::Directory directory;
  const auto light = run(directory.path, turning_shaft("100 N", fatigue + block("light", "100 %")));
  EXPECT_TRUE(first_place(light)["life_h"].is_null());
  EXPECT_EQ(first_place(light)["damage_per_hour"].get<double>(), 0);
  const auto both = run(directory.path, turning_shaft("100 N", fatigue + block("light", "50 %") +
                                                                   block("heavy", "50 %", force("1400 N"))));
  const auto own = both["bodies"]["shaft"]["fatigue"]["places"][0];
  const double limit = own["endurance_Pa"].get<double>() / 1.5, amplitude = own["amplitude_Pa"];
  const double expected = 0.5 * turns_per_hour / (1e6 * std::pow(limit / amplitude, slope));
  EXPECT_NEAR(first_place(both)["by_block"]["light"]["damage_per_hour"].get<double>(), expected,
              1e-8 * expected)
      << "places of equal use may differ by round-off of their limits";
}

// A force that turns with the shaft changes nothing while it runs. Each start brings one cycle from nothing
// to its stress: amplitude and mean are half of it, and M lowers the limit to 1 / (1 + M) at R = 0.
TEST(OperatingBlocks, StartsAreCyclesFromRest) {
  const results_test::Directory directory;
  const auto json =
      run(directory.path,
          "method = \"solid\"\n" +
              small_shaft({{"pull", "middle.fy", "3 kN", 0}}, "mm", "600 rpm", "pressure_harmonics = 0") +
              fatigue + block("running", "100 %", "start = { per_day = 48 }\n"));
  const auto place = first_place(json);
  const auto& starts = place["by_block"]["running"];
  EXPECT_EQ(json["bodies"]["shaft"]["fatigue"]["places"][0]["damage_per_turn"].get<double>(), 0);
  EXPECT_EQ(starts["damage_per_hour"].get<double>(), 0);
  const double peak = json["bodies"]["shaft"]["peak_von_mises"]["value"];
  const double amplitude = starts["start_amplitude_Pa"];
  EXPECT_NEAR(amplitude, peak / 2, 1e-9 * peak);
  const double m = 0.35e-3 * 600 - 0.1, limit = 0.45 * 600e6 / 1.5;
  ASSERT_GT(amplitude * (1 + m), limit) << "the test wants damage";
  const double cycles = 1e6 * std::pow(limit / (amplitude * (1 + m)), slope);
  EXPECT_NEAR(place["life_days"].get<double>(), cycles / 48, 1e-9 * cycles);
  EXPECT_FALSE(json["duty"]["blocks"]["running"]["start_transient"].get<bool>());
}

// A vibratory mill's run-up is followed over time: it closes at every instant, brings its own channels, and
// its largest cycle, from rest to running, is at least that of running. A slow run-up is quasi-static: the
// largest cycle is that of the union of rest and running, which the same start "at once" has, up to what
// weights at rest add.
TEST(OperatingBlocks, AVibratoryMillsRunUpIsFollowed) {
  const results_test::Directory directory;
  const auto start_of = [&](const std::string& start) {
    auto scene = shaft_alone({{"snapshots = 12", "snapshots = 0"},
                              {"pictures = true", "pictures = false"},
                              {"title =", "method = \"beam\"\ntitle ="}});
    scene += "\n[shaft.fatigue]\ntensile_strength = \"900 MPa\"\n";
    scene += block("milling", "100 %", "start = { per_day = 1" + start + " }\n");
    const auto json = run(directory.path, scene);
    EXPECT_EQ(json["duty"]["blocks"]["milling"]["start_transient"].get<bool>(), !start.empty());
    return first_place(json)["by_block"]["milling"];
  };
  const auto followed = start_of(", duration = \"4 s\""), at_once = start_of("");
  const double running = followed["amplitude_Pa"], most = followed["start_amplitude_Pa"];
  EXPECT_GT(most, running);
  EXPECT_NEAR(most, at_once["start_amplitude_Pa"].get<double>(), 0.1 * most);
}

// A train's block beside a natural frequency, over a window that does not close. Red if the warnings of a
// block's loads are lost, as they were, or if a block repeats those of the scene.
TEST(OperatingBlocks, SayWhatTheirLoadsWarnOf) {
  const results_test::Directory directory;
  auto scene = edited("root_peeler_shaft.toml", {{"turns = 272", "turns = 34"},
                                                 {"title =", "method = \"beam\"\ntitle ="},
                                                 {"[shaft]\n", "[shaft]\nfatigue = \"off\"\n"},
                                                 {"[shaft.fatigue]", ""},
                                                 {"roughness = \"6.3 um\"", ""}});
  scene += block("work", "50 %") + block("near", "10 %");
  for (const char* excitation : {"1", "2"})
    scene +=
        std::string("set.\"machine.excitations[") + excitation + "].harmonics[1].frequency\" = \"83.4 Hz\"\n";
  const auto warnings = run(directory.path, scene)["warnings"];
  const auto with = [&](const std::string& begin, const std::string& part) {
    return std::count_if(warnings.begin(), warnings.end(), [&](const auto& warning) {
      const auto text = warning.template get<std::string>();
      return text.rfind(begin, 0) == 0 && text.find(part) != std::string::npos;
    });
  };
  EXPECT_EQ(with("block \"near\": ", "amplified up to 80."), 2) << warnings;
  EXPECT_EQ(with("block \"near\": ", "the vibration repeats after"), 1) << warnings;
  EXPECT_EQ(with("block \"work\": ", ""), 0) << warnings;
}

TEST(OperatingBlocks, AreComputedWhereTheyAreAskedForOnly) {
  const results_test::Directory directory;
  const auto json = run(directory.path, turning_shaft("100 N", fatigue));
  EXPECT_FALSE(json.contains("duty"));
  EXPECT_FALSE(json["timing"].contains("blocks"));
  EXPECT_FALSE(fs::exists(directory / "out/duty.csv"));
}

TEST(OperatingBlocks, KeepTheBody) {
  const results_test::Directory directory;
  const auto refusal = [&](const std::string& command, const std::string& set) {
    write(directory / "scene.toml",
          turning_shaft("100 N", fatigue + block("other", "50 %", "set." + set + "\n")));
    const auto outcome =
        millstress(directory.path, command + " scene.toml" + (command == "run" ? " -o out" : ""));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  };
  // Red if a key is taken in silence: all blocks have the body, its material and its fatigue.
  for (const std::string command : {"check", "run"})
    for (const std::string key :
         {"\"shaft.contour[2].diameter\" = \"11 mm\"", "shaft.material.youngs_modulus = \"70 GPa\"",
          "shaft.material.yield_strength = \"200 MPa\"", "shaft.fatigue.tensile_strength = \"900 MPa\"",
          "shaft.pressure_harmonics = 4", "shaft.torque_support = \"bearing_1\"", "results.snapshots = 3"}) {
      if (command == "run" && key.find("contour") == std::string::npos) continue;
      const auto text = refusal(command, key);
      auto name = key.substr(0, key.find(" ="));
      name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
      EXPECT_NE(text.find("duty[1].set." + name), std::string::npos) << text;
      EXPECT_NE(text.find("a block sets keys of machine, effects and sampling only"), std::string::npos)
          << text;
    }
  EXPECT_NE(refusal("run", "machine.speeed = \"600 rpm\"").find("(in the duty block \"other\")"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(directory / "out"));
}

// A block without keys of its own is the scene's running: it has the same stress at the toes that were solved
// as submodels, too. Red if a block takes the stress of toes from the mesh of the whole body.
TEST(OperatingBlocks, HaveTheStressOfToesThatWereSolvedAsSubmodels) {
  const results_test::Directory directory;
  write(directory / "scene.toml", chamber_alone({{"instants_per_turn = 120", "instants_per_turn = 24"},
                                                 {"cells_through_wall = 2", "cells_through_wall = 1"},
                                                 {"snapshots = 12", "snapshots = 0"},
                                                 {"pictures = true", "pictures = false"},
                                                 {"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}}) +
                                      block("own", "100 %"));
  const auto outcome = millstress(directory.path, "run scene.toml -o out --tolerance none");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = summary(directory / "out");
  const auto& chamber = json["bodies"]["chamber"];
  ASSERT_EQ(chamber["governing"]["kind"], "hot_spot") << "the test wants a toe that leads";
  EXPECT_TRUE(chamber["hot_spots"][0]["extrapolated_from"].is_null()) << "and was solved as a submodel";
  const double own_Pa = chamber["governing"]["value"];
  const auto& in_block = json["duty"]["blocks"]["own"]["bodies"]["chamber"];
  // The same sums in another order.
  EXPECT_NEAR(in_block["von_mises"]["value"].get<double>(), own_Pa, 1e-9 * own_Pa) << in_block;
  const std::string toe = chamber["hot_spots"][0]["name"];
  const auto history =
      millstress(directory.path, "history scene.toml --results out -o h --tolerance none --at '" + toe + "'");
  EXPECT_EQ(history.exit_code, 2) << history.out;
  EXPECT_NE(history.err.find("its stress comes from a submodel"), std::string::npos) << history.err;
  EXPECT_LT(history.err.size(), 2000u) << "no list of dozens of toes";
  for (const auto& warning : json["warnings"])
    EXPECT_EQ(warning.get<std::string>().find("more than the scene's own running"), std::string::npos)
        << warning;
}

// The shipped scene with blocks and the chamber's welds: on the mesh that three seconds allow, with a charge
// that comes round in two turns instead of twenty.
TEST(OperatingBlocks, TheShippedSceneOfAMillRuns) {
  const results_test::Directory directory;
  const auto outcome =
      millstress(directory.path,
                 "run '" + shipped("vibratory_mill_duty.toml").string() +
                     "' -o out -v --time-limit '3 s' --set machine.charge.turn_ratio=-1/2 --set "
                     "sampling.turns=2 --set sampling.instants_per_turn=24 --set results.pictures=false");
  ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 4) << outcome.err;
  const auto duty = summary(directory / "out")["duty"];
  EXPECT_EQ(duty["blocks"].size(), 3u);
  EXPECT_NE(outcome.out.find("lives: Palmgren-Miner over all blocks and starts"), std::string::npos);
  EXPECT_NE(outcome.out.find("S-N slope 3, knee at 1e+07 cycles; behind it 22 and damage sum 1"),
            std::string::npos);
  EXPECT_NE(outcome.out.find("DIN 743 gives no second opinion: it is for shafts"), std::string::npos);
  for (const char* body : {"shaft", "chamber"}) {
    const auto& first = duty["places"][body][0];
    double effects = 0, blocks = 0;
    for (const auto& share : first["effect_share_of_damage"]) effects += share.get<double>();
    for (const auto& block : first["by_block"])
      blocks += block["damage_per_hour"].get<double>() + block["starts_damage_per_hour"].get<double>();
    EXPECT_NEAR(effects, 1, 1e-12) << body;
    const double damage = first["damage_per_hour"];
    EXPECT_NEAR(blocks, damage, 1e-12 * damage) << body;
    if (!first["life_h"].is_null()) {
      const double sum = first["weld_toe"].get<bool>() ? 0.5 : 1;
      EXPECT_NEAR(first["life_h"].get<double>() * damage, sum, 1e-9) << body;
      // 55 % of the time in operation.
      EXPECT_NEAR(first["life_days"].get<double>() * 24 * 0.55 * damage, sum, 1e-9) << body;
    }
  }
  EXPECT_TRUE(duty["places"]["chamber"][0]["weld_toe"].get<bool>()) << "toes of the webs last least";
  // All bodies in one list, by the lives over the blocks; the shaft's first place is printed wherever it
  // stands.
  const auto list = outcome.out.find("fatigue of all bodies, over all blocks, shortest life first");
  ASSERT_NE(list, std::string::npos);
  const auto ranking = summary(directory / "out")["fatigue_ranking"];
  ASSERT_EQ(ranking.size(), duty["places"]["shaft"].size() + duty["places"]["chamber"].size());
  for (const std::string body : {"shaft", "chamber"}) {
    const auto& first = duty["places"][body][0];
    const auto at = std::find_if(ranking.begin(), ranking.end(),
                                 [&](const auto& place) { return place["body"] == body; });
    EXPECT_EQ((*at)["feature"], first["feature"]) << body;
    EXPECT_EQ((*at)["life_h"], first["life_h"]) << body;
    const auto row = "\n  " + body + " +" + first["feature"].get<std::string>() + "  ";
    EXPECT_TRUE(std::regex_search(outcome.out.substr(list), std::regex(row))) << row;
  }
  for (std::size_t i = 1; i < ranking.size(); ++i) {
    const auto &life = ranking[i]["life_h"], &before = ranking[i - 1]["life_h"];
    EXPECT_TRUE(life.is_null() || (!before.is_null() && before.get<double>() <= life.get<double>())) << i;
  }
  EXPECT_NE(results_test::bytes(directory / "out/report.html")
                .find("Fatigue of all bodies, over all operating blocks"),
            std::string::npos);
  EXPECT_EQ(csv(directory / "out/duty.csv").count("damage_share_structure_inertia"), 1u);
}
