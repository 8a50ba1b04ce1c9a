// Fatigue as `millstress run` states it: closed forms of rotating bending and torsion, the share of each
// effect, and what is refused.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/cases/program/field_tables.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

const std::string steel_that_counts =
    "[shaft.fatigue]\ntensile_strength = \"600 MPa\"\nroughness = \"1 um\"\n";

/// @param keys  of [shaft.fatigue] beside the strength
Json fatigue_of(const fs::path& directory, const std::vector<SmallLoad>& loads, const std::string& keys = "",
                std::string* out = nullptr, const std::string& instants = "24") {
  // Pressures without even harmonics, whose part under a seat does not reverse with the force.
  auto scene = small_shaft(loads, "mm", "600 rpm", "pressure_harmonics = 0");
  const std::string given = "instants_per_turn = 24";
  scene.replace(scene.find(given), given.size(), "instants_per_turn = " + instants);
  const auto json = run_small(directory, "method = \"solid\"\n" + scene + steel_that_counts + keys, out);
  return json.is_null() ? Json() : json["bodies"]["shaft"];
}

}  // namespace

// However many instants a turn has, odd ones too: rotating bending has one amplitude, and no mean, to 1e-9.
// Turns red: pairs of instants alone; of nine the amplitude would be 1.5 % smaller.
TEST(Fatigue, DoesNotDependOnWhereTheInstantsLie) {
  const results_test::Directory directory;
  const auto with = [&](const std::string& instants) {
    auto scene =
        small_shaft({{"pull", "volume.ax", "800 m/s2", 1}, {"pull", "volume.ay", "800 m/s2", 1, "90 deg"}},
                    "mm", "600 rpm", "pressure_harmonics = 0");
    const std::string given = "instants_per_turn = 24";
    scene.replace(scene.find(given), given.size(), "instants_per_turn = " + instants);
    return run_small(directory.path, "method = \"solid\"\ntolerance = \"none\"\n" + scene +
                                         steel_that_counts)["bodies"]["shaft"];
  };
  const double peak = with("48")["peak_von_mises"]["value"];  // meets the sixteen nodes of eight sectors
  for (const auto* instants : {"9", "24", "121"}) {
    const auto place = with(instants)["fatigue"]["places"][0];
    EXPECT_NEAR(place["amplitude_Pa"].get<double>(), peak, 1e-9 * peak) << instants;
    EXPECT_NEAR(place["mean_Pa"].get<double>(), 0, 1e-9 * peak) << instants;
  }
}

// A force fixed in space bends the shaft to and fro: mean zero, amplitude the peak. FKM by hand, with
// R_m = 600 MPa: sigma_W = 0.45 R_m, K_R = 1 at 1 um, M = 0.35e-3 R_m - 0.1.
TEST(Fatigue, OfRotatingBendingHasThePeakAsAmplitude) {
  const results_test::Directory directory;
  std::string out;
  // By the shaft's own mass: under a seat the even part of the pressure would not reverse.
  const auto shaft = fatigue_of(
      directory.path, {{"pull", "volume.ax", "800 m/s2", 1}, {"pull", "volume.ay", "800 m/s2", 1, "90 deg"}},
      "", &out, "48");  // instants that meet the sixteen nodes of eight sectors
  const auto& place = shaft["fatigue"]["places"][0];
  const double amplitude = place["amplitude_Pa"], peak = shaft["peak_von_mises"]["value"];
  EXPECT_NEAR(amplitude, peak, 1e-9 * peak);
  EXPECT_NEAR(place["mean_Pa"].get<double>(), 0, 1e-9 * peak);
  const double gradient = place["related_gradient_1_m"];
  EXPECT_NEAR(gradient, 2 / 0.01, 0.05 * 2 / 0.01) << "of a bar in bending: 2 / d";
  const double exponent = 0.5 + 600. / 2700.;
  const double support = 1 + std::sqrt(gradient * 1e-3) * std::pow(10, -exponent);
  EXPECT_NEAR(place["support_factor"].get<double>(), support, 1e-12);
  const double endurance = 0.45 * 600e6 * support;
  EXPECT_NEAR(place["endurance_Pa"].get<double>(), endurance, 1e-9 * endurance);
  EXPECT_NEAR(place["utilisation"].get<double>(), 1.5 * amplitude / endurance, 1e-12);
  EXPECT_EQ(place["damage_per_turn"].get<double>(), 0) << "far below the limit";
  EXPECT_TRUE(place["life_h"].is_null());
  EXPECT_NEAR(place["safety_by"]["goodman"].get<double>(), endurance / amplitude,
              1e-9 * endurance / amplitude);
  EXPECT_NEAR(place["effect_share_of_amplitude"]["pull"].get<double>(), 1, 1e-12);
  EXPECT_NE(out.find("endures"), std::string::npos) << out;
  EXPECT_TRUE(fs::exists(directory / "out/shaft/fatigue.csv"));
}

TEST(Fatigue, OfALoadThatTurnsWithTheShaftHasNoAmplitude) {
  const results_test::Directory directory;
  const auto shaft = fatigue_of(directory.path, {{"pull", "middle.fy", "100 N", 0}});
  const double peak = shaft["peak_von_mises"]["value"];
  for (const auto& place : shaft["fatigue"]["places"]) {
    EXPECT_NEAR(place["amplitude_Pa"].get<double>(), 0, 1e-12 * peak);
    EXPECT_EQ(place["utilisation"].get<double>(), 0);
    EXPECT_TRUE(place["life_h"].is_null());
  }
}

// Above the limit: N = N_D (sigma_D / sigma_a)^5 turns with sigma_D the endurance over the safety factor, one
// cycle a turn; twice the force has a life 32 times shorter, and its amplitude twice.
TEST(Fatigue, LifeFollowsTheSlope) {
  const results_test::Directory directory;
  const auto of = [&](const char* force) {
    const auto shaft =
        fatigue_of(directory.path, fixed_in_space("pull", "middle", force), "wanted_life = \"2 h\"\n");
    return shaft["fatigue"]["places"][0];
  };
  const auto once = of("700 N"), twice = of("1400 N");
  ASSERT_GT(once["damage_per_turn"].get<double>(), 0) << once;
  EXPECT_EQ(once["counted_cycles"], 1);
  const double limit = once["endurance_Pa"].get<double>() / 1.5, amplitude = once["amplitude_Pa"];
  const double turns = 1e6 * std::pow(limit / amplitude, 5);
  EXPECT_NEAR(once["life_turns"].get<double>(), turns, 1e-9 * turns);
  EXPECT_NEAR(once["life_h"].get<double>(), turns / 36000, 1e-9 * turns / 36000) << "600 turns a minute";
  EXPECT_NEAR(twice["life_h"].get<double>() * 32, once["life_h"].get<double>(),
              1e-8 * once["life_h"].get<double>());
  const double wanted_turns = 2 * 36000;
  EXPECT_NEAR(once["life_safety"].get<double>(), std::pow(turns / wanted_turns, 0.2), 1e-9);
}

// Bending amplitude with steady torsion: the mean is that of the torsion, positive, and lowers the limit by
// M.
TEST(Fatigue, ASteadyTorqueIsAMeanStress) {
  const results_test::Directory directory;
  auto loads = fixed_in_space("pull", "middle", "100 N");
  loads.push_back({"twist", "middle.torque", "10 N m"});
  const auto shaft = fatigue_of(directory.path, loads);
  // Beside the port where the torque enters it is whole.
  const auto& places = shaft["fatigue"]["places"];
  const auto found =
      std::find_if(places.begin(), places.end(), [](const auto& p) { return p["feature"] == "right"; });
  ASSERT_NE(found, places.end());
  const auto& place = *found;
  const double amplitude = place["amplitude_Pa"], mean = place["mean_Pa"];
  EXPECT_NEAR(mean, std::sqrt(3.0) * 16 * 10 / (M_PI * 1e-6), 0.05 * mean) << "16 T / (pi d^3)";
  const double m = 0.35e-3 * 600 - 0.1, x = mean / amplitude;
  const double factor = x <= 1   ? 1 / (1 + m * x)
                        : x <= 3 ? (1 + m / 3) / (1 + m) / (1 + m * x / 3)
                                 : (1 + m / 3) / ((1 + m) * (1 + m));
  EXPECT_NEAR(place["endurance_Pa"].get<double>(),
              0.45 * 600e6 * place["support_factor"].get<double>() * factor, 1);
  EXPECT_NEAR(place["effect_share_of_amplitude"]["pull"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(place["effect_share_of_amplitude"]["twist"].get<double>(), 0, 1e-9);
}

TEST(Fatigue, NamesTheRules) {
  const results_test::Directory directory;
  std::string out;
  fatigue_of(directory.path, fixed_in_space("pull", "middle", "100 N"), "", &out);
  for (const auto* words : {"half the von Mises stress of the difference", "signed von Mises", "Haigh", "F2",
                            "rainflow along the direction of most damage", "Palmgren-Miner", "elementary",
                            "Findley with tau_W / sigma_W 0.577"})
    EXPECT_NE(out.find(words), std::string::npos) << words << '\n' << out;
}

TEST(Fatigue, IsJudgedWhereItIsAskedForOnly) {
  const results_test::Directory directory;
  std::string out;
  const auto json = run_small(
      directory.path,
      "method = \"solid\"\n" + small_shaft({{"pull", "middle.fy", "100 N"}}, "mm", "600 rpm", ""), &out);
  EXPECT_FALSE(json["bodies"]["shaft"].contains("fatigue"));
  EXPECT_FALSE(json["timing"].contains("fatigue"));
  EXPECT_FALSE(fs::exists(directory / "out/shaft/fatigue.csv"));
}

TEST(Fatigue, RefusesWhatItCannotJudge) {
  const results_test::Directory directory;
  const auto refusal = [&](const std::string& keys) {
    write(directory / "scene.toml",
          small_shaft({{"pull", "middle.fy", "100 N"}}, "mm", "600 rpm", "") + keys);
    const auto run = millstress(directory.path, "run scene.toml -o out");
    EXPECT_EQ(run.exit_code, 2) << keys << run.out;
    return run.err;
  };
  const std::string table = "[shaft.fatigue]\n";
  EXPECT_NE(refusal(table).find("shaft.fatigue.tensile_strength"), std::string::npos);
  EXPECT_NE(refusal(table + "tensile_strength = \"200 MPa\"\n").find("yield_strength"), std::string::npos);
  EXPECT_NE(refusal(steel_that_counts + "group = \"wood\"\n").find("is no material group"),
            std::string::npos);
  EXPECT_NE(refusal(steel_that_counts + "consequences = \"none\"\n").find("severe"), std::string::npos);
  EXPECT_NE(refusal(steel_that_counts + "safety_factor = 2\ninspected = true\n").find("remove one"),
            std::string::npos);
  EXPECT_NE(refusal("[shaft.fatigue]\ntensile_strength = \"2 GPa\"\ngroup = \"wrought aluminium\"\n")
                .find("the group's rules refuse it"),
            std::string::npos);
  EXPECT_NE(refusal(steel_that_counts + "casting_tested = true\n").find("no casting"), std::string::npos);
  EXPECT_NE(refusal(steel_that_counts + "roughnes = \"1 um\"\n").find("roughness"), std::string::npos);
  EXPECT_FALSE(fs::exists(directory / "out"));
}

// A chamber's toes: the range of the governing direction is not below that across the toe, which the run
// states of the same history; life is the period over the damage; a toe that is not there is refused.
// A toe's damage is at least that of one cycle of the range across it, in 20 turns of the drive: IIW's curve
// for FAT 90 below the knee, whose fifth power holds above it as well as a lower bound no longer, hence the
// minimum.
TEST(Fatigue, WeldToesHaveAtLeastTheDamageAcrossThem) {
  const results_test::Directory directory;
  const auto chamber = chamber_alone({{"  \"gravity_shaft\", \"shaft_inertia\",", "  #"},
                                      {"instants_per_turn = 120", "instants_per_turn = 24"},
                                      {"cells_through_wall = 2", "cells_through_wall = 1"},
                                      {"level = \"50 % of peak\"", "level = \"20 % of peak\""},
                                      {"snapshots = 12", "snapshots = 0"},
                                      {"pictures = true", "pictures = false"},
                                      {"wanted_life = \"2000 h\"", "tensile_strength = \"510 MPa\""}});
  const auto json = run_small(directory.path, chamber);
  const auto& body = json["bodies"]["chamber"];
  const auto &spots = body["hot_spots"], &welds = body["fatigue"]["welds"];
  ASSERT_GE(welds.size(), 2u);
  ASSERT_EQ(welds.size(), spots.size());
  EXPECT_NE(body["fatigue"]["assumptions"].dump().find("welds of webs on the housing"), std::string::npos)
      << "what is not judged is said";
  EXPECT_GT(body["zones"].size(), 10u) << "more than the terminal shows";
  for (const auto& zone : body["zones"]) EXPECT_TRUE(zone.contains("causes")) << zone;
  int n_ranges = 0;
  for (const auto& weld : welds)
    for (const auto& spot : spots) {
      if (weld["name"] != spot["name"]) continue;
      // Not less than all that is stated of the toe's stress: numbers, load patches and the rest.
      const auto stated = !spot["error"].is_null() ? spot["error"]["total"] : spot["error_Pa"];
      EXPECT_GE(weld["stress_error"].get<double>() * (1 + 1e-9),
                stated.get<double>() / spot["von_mises_Pa"].get<double>())
          << weld;
      const double across = spot["normal_max_Pa"].get<double>() - spot["normal_min_Pa"].get<double>();
      const double knee_Pa = 90e6 * std::cbrt(2e6 / 1e7), ratio = across / knee_Pa;
      const double damage = std::min(std::pow(ratio, 3), std::pow(ratio, 5)) / 1e7 / 20;
      EXPECT_GE(weld["damage_per_turn"].get<double>(), damage * (1 - 1e-9)) << weld;
      EXPECT_LE(std::abs(weld["angle_rad"].get<double>()), M_PI / 3 + 1e-9);
      EXPECT_EQ(weld["class_Pa"].get<double>(), 90e6);
      EXPECT_EQ(weld["type"], "load-carrying");
      double sum = 0;
      for (const auto& share : weld["effect_share_of_range"]) sum += share.get<double>();
      EXPECT_NEAR(sum, 1, 1e-9) << weld;
      // Life goes with the third to the fifth power of the range.
      if (!weld["life_h"].is_null() && !weld["life_range_h"].is_null()) {
        ++n_ranges;
        const double life = weld["life_h"], error = weld["stress_error"], least = weld["life_range_h"][0];
        EXPECT_LE(least, life * std::pow(1 + error, -3) * (1 + 1e-9)) << weld;
        EXPECT_GE(least, life * std::pow(1 + error, -5) * (1 - 1e-9)) << weld;
      }
      EXPECT_EQ(weld["damage_per_turn"].get<double>() > 0, !weld["life_h"].is_null());
      // To IIW's damage sum, in hours of turns at 151.844 rad/s.
      if (!weld["life_h"].is_null()) {
        const double turns = weld["life_h"].get<double>() * 3600 * 151.844 / (2 * M_PI);
        EXPECT_NEAR(turns * weld["damage_per_turn"].get<double>(), weld["counted_cycles"] > 1 ? 0.5 : 1, 1e-9)
            << weld;
      }
    }
  EXPECT_GE(n_ranges, 1);
  const auto files = expect_fields_of_readme(directory / "out");
  EXPECT_EQ(files.count("weld_fatigue.csv") + files.count("hot_spots.csv"), 2u);
  write(directory / "scene.toml",
        chamber + "[[chamber.fatigue.welds.toes]]\nname = \"nowhere\"\nclass = \"100 MPa\"\n");
  const auto refused = millstress(directory.path, "run scene.toml -o out");
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_NE(refused.err.find("is no weld toe of this body"), std::string::npos) << refused.err;
}

// Beyond the yield strength no S-N curve holds: M = F l / 4 and sigma = 32 M / (pi d^3) is 305 MPa at 299 N.
// Red if a range is stated, or if the place is passed over in silence.
TEST(Fatigue, LivesBeyondTheYieldStrengthAreNone) {
  const results_test::Directory directory;
  const auto run = [&](const char* force, const std::string& keys = "") {
    return run_small(directory.path, small_shaft(fixed_in_space("pull", "middle", force), "mm", "600 rpm",
                                                 "pressure_harmonics = 0") +
                                         "[shaft.fatigue]\ntensile_strength = \"600 MPa\"\n" + keys);
  };
  const auto warning = [](const Json& json, const std::string& text) {
    for (const auto& sentence : json["warnings"])
      if (sentence.get<std::string>().find(text) != std::string::npos) return sentence.get<std::string>();
    return std::string();
  };
  const auto beyond = run("400 N"), within = run("250 N");
  const auto& worst = beyond["bodies"]["shaft"]["fatigue"]["places"][0];
  EXPECT_FALSE(worst["life_h"].is_null());
  EXPECT_TRUE(worst["life_range_h"].is_null()) << worst;
  EXPECT_NE(worst["beyond_sn_curve"].get<std::string>().find("exceed the yield strength, 305 MPa"),
            std::string::npos)
      << worst;
  EXPECT_NE(warning(beyond, "exceed the yield strength"), "") << beyond["warnings"];
  const auto& other = within["bodies"]["shaft"]["fatigue"]["places"][0];
  EXPECT_TRUE(other["beyond_sn_curve"].is_null()) << other;
  EXPECT_EQ(warning(within, "exceed the yield strength"), "") << within["warnings"];
  // 45 % of 600 MPa endure in reversed tension on a smooth surface; three times that are more than 305 MPa.
  EXPECT_NE(warning(run("10 N", "surface_treatment = 3\n"), "check surface_treatment = 3"), "");
}

// Shares in damage are Miner's derivative: whole runs with one effect's load 1e-4 larger and smaller. Its
// damage changes by 2e-4 k times the share, k = 5 (steel; all cycles, as one is above the knee). Red if the
// shares are those of the amplitude, in which the constant torque has none.
TEST(Fatigue, SharesInDamagePredictWholeRuns) {
  const results_test::Directory directory;
  const auto with = [&](double pull, double twist, double press) {
    const auto newtons = [](double size) { return std::to_string(size) + " N"; };
    auto loads = fixed_in_space("pull", "middle", newtons(250 * pull));
    loads.push_back({"press", "middle.torque", newtons(20 * press) + " m", 0});
    loads.push_back({"twist", "middle.torque", newtons(8 * twist) + " m", 2});
    return run_small(directory.path, "method = \"solid\"\ntolerance = \"none\"\n" +
                                         small_shaft(loads, "mm", "600 rpm", "pressure_harmonics = 0") +
                                         steel_that_counts)["bodies"]["shaft"];
  };
  const auto damage = [](const Json& shaft) {
    return shaft["fatigue"]["places"][0]["damage_per_turn"].get<double>();
  };
  constexpr double step = 1e-4, slope = 5;
  const auto shaft = with(1, 1, 1);
  const auto& shares = shaft["fatigue"]["places"][0]["effect_share_of_damage"];
  ASSERT_GT(damage(shaft), 0);
  ASSERT_EQ(shares.size(), 3u);
  const auto share = [&](const char* effect) { return shares[effect].get<double>(); };
  EXPECT_NEAR(share("pull") + share("twist") + share("press"), 1, 1e-12);
  const auto by_runs = [&](const Json& more, const Json& less) {
    return std::log(damage(more) / damage(less)) / (2 * step * slope);
  };
  // Crests are found to 1e-6 of a cycle, and differ between runs by a part of that.
  EXPECT_NEAR(share("pull"), by_runs(with(1 + step, 1, 1), with(1 - step, 1, 1)), 1e-4);
  EXPECT_NEAR(share("twist"), by_runs(with(1, 1 + step, 1), with(1, 1 - step, 1)), 1e-4);
  EXPECT_NEAR(share("press"), by_runs(with(1, 1, 1 + step), with(1, 1, 1 - step)), 1e-4);
  EXPECT_GT(share("press"), 0.01) << "by FKM's M; none of the amplitude";
  // The zone on that place, by effect and by channel; and the table.
  const auto& zone = shaft["zones"][0]["causes"]["damage"];
  EXPECT_GT(zone["damage_per_turn"].get<double>(), 0);
  double of_channels = 0;
  for (const auto& own : zone["channels"]) of_channels += own.get<double>();
  EXPECT_NEAR(of_channels, 1, 1e-12);
  const auto table = csv(directory / "out/shaft/fatigue.csv");
  const auto places = summary(directory / "out")["bodies"]["shaft"]["fatigue"]["places"];  // of the last run
  EXPECT_EQ(table.at("damage_share_pull").size(), places.size());
  // The table's row is that of summary.json: shares of the amplitude are not those of the damage.
  for (const std::string effect : {"pull", "twist", "press"})
    EXPECT_NEAR(table.at("amplitude_share_" + effect)[0],
                100 * places[0]["effect_share_of_amplitude"][effect].get<double>(), 1e-9)
        << effect;
  const double per_hour = places[0]["damage_per_hour"];
  EXPECT_NEAR(table.at("damage_per_hour")[0], per_hour, 1e-14 * per_hour) << "fifteen digits";
  EXPECT_NEAR(table.at("damage_per_hour")[0] * table.at("life")[0], 1, 1e-12);
}

// The tensile strength of the part: K_d times that of the scene, by name in the output; nonsense is refused.
TEST(Fatigue, HaveASizeFactor) {
  const results_test::Directory directory;
  std::string out;
  const auto shaft = [&](const std::string& keys) {
    return run_small(
        directory.path,
        small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", "pressure_harmonics = 0") +
            steel_that_counts + keys,
        &out)["bodies"]["shaft"]["fatigue"];
  };
  const auto plain = shaft("");
  EXPECT_NE(out.find("R_m 600 MPa (of the part at its size: size_factor 1)"), std::string::npos) << out;
  // Which size the strength is for stands before all safeties and lives, in one line.
  const auto line = out.find("shaft: fatigue strength: R_m 600 MPa, taken as that of the part at its size");
  ASSERT_NE(line, std::string::npos) << out;
  EXPECT_LT(line, out.find("amplitude MPa")) << "before the table of lives";
  EXPECT_NE(out.substr(line, out.find('\n', line) - line).find("survival 97.5 %"), std::string::npos) << out;
  const auto page = results_test::bytes(directory / "out/report.html");
  EXPECT_LT(page.find("fatigue strength: R_m 600 MPa"), page.find("afety against"));
  const auto text = results_test::bytes(directory / "out/summary.json");
  EXPECT_LT(text.find("\"fatigue_strength\""), text.find("\"safety_against"));
  const auto scaled = shaft("size_factor = 0.9\n");
  EXPECT_NE(out.find("R_m 540 MPa (600 MPa by size_factor 0.9)"), std::string::npos) << out;
  EXPECT_NE(out.find("R_m 540 MPa of the part at its size, 600 MPa times size_factor 0.9"), std::string::npos)
      << out;
  EXPECT_EQ(out.find("K_d at"), std::string::npos) << "asked and answered";
  EXPECT_EQ(scaled["size_factor"]["value"].get<double>(), 0.9);
  auto by_hand =
      small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", "pressure_harmonics = 0");
  by_hand += "[shaft.fatigue]\ntensile_strength = \"540 MPa\"\nroughness = \"1 um\"\n";
  const auto other = run_small(directory.path, by_hand)["bodies"]["shaft"]["fatigue"];
  const double endured = scaled["places"][0]["endurance_Pa"];
  EXPECT_NEAR(endured, other["places"][0]["endurance_Pa"].get<double>(), 1e-9 * endured);
  EXPECT_LT(endured, plain["places"][0]["endurance_Pa"].get<double>());
  const auto refusal = [&](const std::string& keys) {
    write(directory / "scene.toml",
          small_shaft(fixed_in_space("pull", "middle", "100 N")) + steel_that_counts + keys);
    const auto outcome = millstress(directory.path, "check scene.toml");
    EXPECT_EQ(outcome.exit_code, 2) << keys << outcome.out;
    return outcome.err;
  };
  EXPECT_NE(refusal("size_factor = 0\n").find("shaft.fatigue.size_factor = 0"), std::string::npos);
  EXPECT_NE(refusal("size_factor = 40\n").find("shaft.fatigue.size_factor = 40"), std::string::npos);
  EXPECT_NE(refusal("size_factor = 0.5\n")
                .find("makes the tensile strength less than the material's yield_strength"),
            std::string::npos);
}

// Type and class of weld toes.
TEST(Fatigue, WeldToesHaveTypesAndClasses) {
  const results_test::Directory directory;
  const auto checked = [&](const std::string& keys) {
    write(directory / "scene.toml",
          chamber_alone({{"  \"gravity_shaft\", \"shaft_inertia\",", "  #"},
                         {"wanted_life = \"2000 h\"", "tensile_strength = \"510 MPa\"\n" + keys + "#"}}));
    return millstress(directory.path, "check scene.toml");
  };
  const auto expect_refused = [&](const std::string& keys, const std::string& text) {
    const auto outcome = checked(keys);
    EXPECT_EQ(outcome.exit_code, 2) << keys << outcome.out;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
  };
  EXPECT_EQ(checked("welds.class = \"FAT 100\"\n").exit_code, 0);
  EXPECT_EQ(checked("welds.type = \"butt\"\n").exit_code, 0);
  expect_refused("welds.class = \"FAT 95\"\n", "is no FAT class; IIW has FAT 36, 40,");
  expect_refused("welds.type = \"glued\"\n", "write one of load-carrying, non-load-carrying");
  expect_refused("welds.type = \"butt\"\nwelds.class = \"FAT 90\"\n", "stands beside type");
  expect_refused("[[chamber.fatigue.welds.toes]]\nname = \"any\"\n", "of which nothing is said");
  const auto own = checked("welds.class = \"95 MPa\"\n");
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_NE((own.out + own.err).find("class 95 MPa is no FAT class of IIW"), std::string::npos)
      << own.out << own.err;
}

// What a beam does not know is not said to be safe, and its whole error is stated.
TEST(Fatigue, OfABeamStatesWhatIsNotKnown) {
  const results_test::Directory directory;
  const auto outcome =
      as_a_user(directory.path, "run '" + shipped("shaft.toml").string() + "' --method beam -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ((outcome.out + outcome.err).find("which is safe"), std::string::npos);
  EXPECT_EQ((outcome.out + outcome.err).find("known to nothing"), std::string::npos);
  const auto shaft = summary(directory / "out")["bodies"]["shaft"];
  for (const auto& zone : shaft["zones"]) EXPECT_TRUE(zone["volume_m3"].is_null()) << zone;
  const auto governing = shaft["governing"];
  const auto& error = governing["error"];
  EXPECT_NEAR(error["numerical"].get<double>() + error["model"].get<double>(), error["total"].get<double>(),
              1e-9 * error["total"].get<double>());
  EXPECT_NEAR(error["beam_model"].get<double>() + error.value("near_loads", 0.0) +
                  error.value("ovalisation", 0.0) + error.value("spin", 0.0),
              error["model"].get<double>(), 1e-9 * error["total"].get<double>());
  const double total = governing["error"]["total"].get<double>() / governing["value"].get<double>();
  char text[80];
  std::snprintf(text, sizeof text, "is known to %.2g %% only, all its errors together", 100 * total);
  EXPECT_NE(outcome.out.find(text), std::string::npos) << text << outcome.out;
}
