// Other rules of fatigue beside FKM's, as `millstress run` states them: DIN 743 and its nominal stresses,
// Goodman, Gerber and Soderberg, Findley.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

/// The shipped shaft under static bending by 20 kN, reversed torsion, and a force across the bending.
std::string steady_bending(const std::string& alternating) {
  return with_edits(
      without("shaft.toml", R"(effects = ["belt", "drive", "unbalance", "spin"])", "[sampling]"),
      {{"title = ", "method = \"axisymmetric\"\ntolerance = \"none\"\ntitle = "},
       {"[sampling]\ninstants_per_turn = 120", R"(effects = ["pull", "drive"]
[machine]
type = "load_table"
speed = "960 rpm"
constants = [{ effect = "pull", load = "pulley.fx", value = "20 kN" }]
harmonics = [{ effect = "drive", load = "roller.torque", amplitude = "60 N m", order = 2, phase = "0 deg" },
             { effect = "drive", load = "pulley.fy", amplitude = ")" +
                                                   alternating + R"(", order = 2, phase = "0 deg" }]
[sampling]
instants_per_turn = 48)"},
       {"pictures = true", "pictures = false"}});
}

}  // namespace

// The shipped shaft: nominal bending of its fillets by hand, M / (pi d^3 / 32) of the section beside them,
// and DIN 743 near FKM's safety: two guidelines, one local stress. They differ by factors for size, support
// and mean of some per cent each; a notch counted twice or not at all would be a factor of two.
TEST(Fatigue, OfFilletsHasASecondOpinionByDin743) {
  const results_test::Directory directory;
  const auto run =
      millstress(directory.path, "run " + shipped("shaft.toml").string() +
                                     " -v --method axisymmetric --set results.pictures=false -o out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto fatigue = summary(directory / "out")["bodies"]["shaft"]["fatigue"];
  const auto& din = fatigue["din_743"];
  ASSERT_EQ(din.size(), 3u);
  for (const auto& place : fatigue["places"]) {
    if (place["feature"] != din[0]["feature"]) continue;
    const double fkm = place["safety_against_endurance"], own = din[0]["safety_against_fatigue"];
    EXPECT_NEAR(own, fkm, 0.25 * fkm);
    const auto& nominal = din[0]["amplitude_Pa"];
    const auto& shape = din[0]["shape_factor"];
    const double local = shape["bending"].get<double>() * nominal["bending"].get<double>();
    const double amplitude = place["amplitude_Pa"];
    EXPECT_NEAR(local, amplitude, 1e-9 * amplitude) << "bending alone alternates there";
    EXPECT_EQ(din[0]["stress_error"], place["stress_error"]) << "of that amplitude";
  }
  EXPECT_NE(run.out.find("DIN 743, nominal stresses (1.2 is asked)"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("error of factors %"), std::string::npos) << run.out;
  // The page has the first place's instants, what other rules say of it, and every fillet by DIN 743.
  const auto page = results_test::bytes(directory / "out/report.html");
  const auto& first = fatigue["places"][0];
  const auto cell = [](const Json& value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value.get<double>());
    return "<td class=\"number\">" + std::string(text) + "</td>";
  };
  std::string others;
  for (const char* rule : {"findley", "goodman", "gerber", "soderberg"})
    others += cell(first["safety_by"][rule]);
  EXPECT_NE(page.find(others), std::string::npos) << others;
  for (const auto& fillet : din) {
    char safety[64];
    std::snprintf(safety, sizeof safety, "<td class=\"number\">%.2f (%.2f)</td>",
                  fillet["safety_against_fatigue"].get<double>(),
                  fillet["safety_against_fatigue_least"].get<double>());
    EXPECT_NE(page.find(safety + cell(fillet["safety_against_yielding"])), std::string::npos)
        << fillet["feature"] << safety;
  }
  for (const char* end : {"from", "to"}) {
    char text[64];
    std::snprintf(text, sizeof text, "<td>turn %d, %.0f deg</td>", first[end]["turn"].get<int>(),
                  first[end]["drive_angle_rad"].get<double>() * 180 / M_PI);
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

// 20 kN of static bending and reversed torsion: 1 N that alternates across the bending, or none, is all the
// same to every rule. Turns red: mean bending along the direction of the change alone (DIN 743 of 10
// for 2.3), Shigley's lines at the node that FKM takes, to which means beyond R = 0.5 are equal
// (Soderberg 1.18 for 0.90).
TEST(Fatigue, ALittleForceMovesNoSecondOpinion) {
  const results_test::Directory directory;
  const auto with = [&](const char* force) {
    return run_small(directory.path, steady_bending(force))["bodies"]["shaft"]["fatigue"];
  };
  const auto without = with("0 N"), little = with("1 N");
  ASSERT_EQ(little["din_743"].size(), without["din_743"].size());
  for (const auto* key : {"safety_against_fatigue", "safety_against_yielding"}) {
    const double expected = without["din_743"][0][key];
    EXPECT_NEAR(little["din_743"][0][key].get<double>(), expected, 1e-3 * expected) << key;
  }
  // Amplitudes of 1 N are 4e-4 of those of the torsion, in some direction or other.
  for (const auto* rule : {"findley", "goodman", "gerber", "soderberg"}) {
    const double expected = without["places"][0]["safety_by"][rule];
    EXPECT_NEAR(little["places"][0]["safety_by"][rule].get<double>(), expected, 3e-3 * expected) << rule;
  }
  // M / (pi d^3 / 32) where the pulley's fillet of 1.5 mm begins, 18.5 mm from the middle of its seat.
  const double nominal_Pa = 20e3 * 0.0185 / (M_PI * std::pow(0.03, 3) / 32);
  EXPECT_EQ(little["din_743"][0]["feature"], "fillet pulley/bearing_1");
  EXPECT_NEAR(little["din_743"][0]["mean_Pa"]["bending"].get<double>(), nominal_Pa, 0.01 * nominal_Pa);
}

// Findley sees crests between the instants, as FKM does.
TEST(Fatigue, FindleyDoesNotDependOnTheInstants) {
  const results_test::Directory directory;
  const auto with = [&](const std::string& instants) {
    const auto run = millstress(directory.path, "run " + shipped("shaft.toml").string() +
                                                    " --method axisymmetric --set results.pictures=false "
                                                    "--set sampling.instants_per_turn=" +
                                                    instants + " --force -o out");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return summary(directory / "out")["bodies"]["shaft"]["fatigue"]["places"][0]["safety_by"];
  };
  const auto few = with("24"), many = with("360");
  const double expected = many["findley"];
  // Crests are missed by (pi / (8 * 48))^2 / 2 = 3e-5 of the amplitude.
  EXPECT_NEAR(few["findley"].get<double>(), expected, 1e-4 * expected);
}
