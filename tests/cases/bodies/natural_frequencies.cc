// Natural frequencies in a run: those of a bar between two bearings, and what they say of its loads.
#include <cmath>
#include <cstdio>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

constexpr double e_Pa = 206e9, rho_kg_m3 = 7850;

/// Pinned at both ends: w = (n pi / L)^2 sqrt(E I / rho A), less the first order of Timoshenko's correction
/// for rotary inertia and shear. Source: Timoshenko, Vibration Problems in Engineering, art. on lateral
/// vibration.
double pinned_bar_Hz(int n) {
  const double radius_m = small_diameter / 2e3, length_m = small_span / 1e3, gyration_m = radius_m / 2;
  const double wave = n * M_PI / length_m, thick = wave * wave * gyration_m * gyration_m;
  const double shear = e_Pa / (0.9 * e_Pa / 2.6);
  return wave * wave * gyration_m * std::sqrt(e_Pa / rho_kg_m3) * (1 - thick / 2 * (1 + shear)) / (2 * M_PI);
}

std::string rpm(double hertz) {
  return std::to_string(60 * hertz) + " rpm";
}

bool warns(const nlohmann::json& json) {
  for (const auto& warning : json["warnings"])
    if (warning.get<std::string>().find("natural frequency") != std::string::npos) return true;
  return false;
}

nlohmann::json shaken(const fs::path& directory, const std::string& speed, int order,
                      std::string* out = nullptr) {
  return run_small(directory, small_shaft({{"shake", "middle.fy", "100 N", order}}, "mm", speed), out);
}

}  // namespace

TEST(NaturalFrequencies, OfABarBetweenBearingsAreThoseOfABeam) {
  const results_test::Directory directory;
  std::string text;
  const auto shaft = shaken(directory.path, "600 rpm", 1, &text)["bodies"]["shaft"];
  ASSERT_EQ(shaft["natural_frequencies"].size(), 2u);
  // A pair, for the bar is round. Seats of 1 % of the span hold its mean over them, and 2 mm stand over: 1 %.
  for (const auto& f : shaft["natural_frequencies"])
    EXPECT_NEAR(f["value"].get<double>(), pinned_bar_Hz(1), 0.01 * pinned_bar_Hz(1));
  EXPECT_EQ(shaft["natural_frequencies"][0]["unit"], "Hz");
  EXPECT_EQ(shaft["dynamic_amplification"]["held"], "pinned at bearing_1, bearing_2");
  EXPECT_NE(text.find("natural frequency Hz"), std::string::npos) << text;
  EXPECT_NE(text.find("resonance puts at most a factor"), std::string::npos) << text;
}

// Forty diameters long, rounding leaves 1.65e-6 of the inertia forces unbalanced, which moves no frequency.
// The bar of 810 mm is pinned in the middle of its seats of 20 mm, which hold 1 % of the span.
TEST(NaturalFrequencies, OfASlenderShaftAreThoseOfABeam) {
  const results_test::Directory directory;
  const auto segment = [](const std::string& what, const std::string& length) {
    return "{ " + what + ", diameter = \"20 mm\", length = \"" + length + " mm\" },\n";
  };
  auto text = small_shaft({{"shake", "middle.fy", "100 N", 1}}, "mm", "600 rpm", "natural_frequencies = 4");
  const auto begin = text.find("contour = ["), end = text.find("]\nbearings");
  text.replace(begin, end - begin,
               "contour = [\n" + segment("port = \"bearing_1\"", "20") + segment("name = \"left\"", "380") +
                   segment("port = \"middle\"", "10") + segment("name = \"right\"", "380") +
                   segment("port = \"bearing_2\"", "20"));
  text = with_edits(text, {{"sectors = 8", "sectors = 12"}});
  const auto shaft = run_small(directory.path, text)["bodies"]["shaft"];
  const double gyration_m = 0.005, length_m = 0.79, wave = M_PI / length_m;
  const double by_beam_Hz = wave * wave * gyration_m * std::sqrt(e_Pa / rho_kg_m3) / (2 * M_PI);
  EXPECT_NEAR(shaft["natural_frequencies"][0]["value"].get<double>(), by_beam_Hz, 0.01 * by_beam_Hz);
}

// The shell's first two ovals are at 540.6 Hz by 48 sectors and 648 k unknowns. Eight sectors, which are
// enough for the stress, hold it round: that pair was missing, below 604.9, 739 and 1002 Hz.
TEST(NaturalFrequencies, OfADrumHaveItsOvals) {
  const results_test::Directory directory;
  write(directory / "scene.toml", edited("planetary_mill.toml", {}));
  const auto run =
      millstress(directory.path,
                 "run scene.toml -o out --tolerance '20 %' --set machine.drum.mass=removed "
                 "--set drum.natural_frequencies=4 --set 'effects=[\"drum_gravity\", \"drum_spin\"]' "
                 "--set sampling.instants_per_turn=24 --set drum.mesh.sectors=16 "
                 "--set results.pictures=false --set results.snapshots=0");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  constexpr double oval_Hz = 540.6;
  int n_ovals = 0;
  const auto json = summary(directory / "out");
  for (const auto& f : json["bodies"]["drum"]["natural_frequencies"]) {
    const double most_Hz = f["value"], least_Hz = most_Hz - f["error"].get<double>();
    std::printf("%.2f Hz, at least %.2f\n", most_Hz, least_Hz);
    n_ovals += least_Hz <= oval_Hz && oval_Hz <= most_Hz;
  }
  EXPECT_EQ(n_ovals, 2);
  EXPECT_NE(json["warnings"].dump().find("may be lower by"), std::string::npos) << json["warnings"];
}

// A mass beside the bearings swings on the shaft like one on a spring: four times as much at half the
// frequency. The shaft's own, 0.4 kg, is beside them.
TEST(NaturalFrequencies, KnowAddedMasses) {
  const results_test::Directory directory;
  const auto lowest_Hz = [&](const std::string& mass) {
    write(directory / "scene.toml",
          without("root_peeler_shaft.toml", "[shaft.fatigue]", "[shaft.mesh]") +
              "\n[[shaft.added_masses]]\nname = \"disc\"\nport = \"disc_seat\"\nmass = \"" + mass + "\"\n");
    const auto run =
        millstress(directory.path,
                   "run scene.toml -o out --set sampling.turns=8 --set sampling.instants_per_turn=24 "
                   "--set shaft.natural_frequencies=1 --set results.pictures=false "
                   "--set shaft.mesh.cells_per_fillet_quarter=2");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return summary(directory / "out")["bodies"]["shaft"]["natural_frequencies"][0]["value"].get<double>();
  };
  EXPECT_NEAR(lowest_Hz("20 kg") / lowest_Hz("80 kg"), 2, 0.02);
}

// One harmonic of all the stress at f: 1 / (1 - (f / f1)^2), with f1 as low as it may be where that is more.
// Near a tenth of f1 that is 1 %, near a fifth 4 %.
TEST(NaturalFrequencies, AFastShaftIsWarnedOf) {
  const results_test::Directory directory;
  const auto lowest = shaken(directory.path, "600 rpm", 1)["bodies"]["shaft"]["natural_frequencies"][0];
  const double f1 = lowest["value"], least = f1 - lowest["error"].get<double>();
  ASSERT_LT(least, 0.9999 * f1) << "else this test does not see which bound counts";
  for (const auto& [share, order] : {std::pair{0.095, 1}, {0.19, 1}, {0.095, 2}, {1.5, 1}}) {
    const auto json = shaken(directory.path, rpm(share * f1), order);
    const auto& dynamic = json["bodies"]["shaft"]["dynamic_amplification"];
    // A table does not say whether its axes turn with the shaft: then it is shaken once a turn more, or less.
    double ratio = 0, expected = 1;
    for (const double by : {-1, 0, 1})
      for (const double to : {f1, least}) {
        const double r = share * (order + by) * f1 / to, amplified = 1 / std::abs(1 - r * r);
        if (std::abs(amplified - 1) <= std::abs(expected - 1)) continue;
        expected = amplified;
        ratio = share * (order + by);
      }
    const auto& line = dynamic["highest_harmonic"];
    EXPECT_NEAR(line["amplification"].get<double>(), expected, 1e-6 * expected);
    EXPECT_NEAR(line["share"].get<double>(), 1, 0.01);
    // Under the middle seat the one-sided pressure adds higher harmonics: a percent, and 1e-4 near resonance.
    EXPECT_NEAR(dynamic["value"].get<double>() - 1, std::abs(expected - 1),
                0.05 * std::abs(expected - 1) + 1e-3)
        << share;
    EXPECT_NEAR(line["frequency_Hz"].get<double>(), ratio * f1, 1e-6 * f1);
    EXPECT_NEAR(line["order"].get<double>(), order, 1e-12);
    EXPECT_EQ(warns(json), ratio > 0.15) << share << " " << order;
  }
}

// An imbalance stands still in the shaft's axes and shakes it once a turn. Read as a force at rest it was
// said to shake nothing.
TEST(NaturalFrequencies, AnImbalanceMeetsTheCriticalSpeed) {
  const results_test::Directory directory;
  const auto lowest = shaken(directory.path, "600 rpm", 1)["bodies"]["shaft"]["natural_frequencies"][0];
  const double f1 = lowest["value"], ratio = 0.95 * f1 / (f1 - lowest["error"].get<double>());
  const auto json = shaken(directory.path, rpm(0.95 * f1), 0);
  const double expected = 1 / (1 - ratio * ratio);
  EXPECT_NEAR(json["bodies"]["shaft"]["dynamic_amplification"]["value"].get<double>(), expected,
              0.05 * expected);
  EXPECT_TRUE(warns(json));
}

// A torque holds the peak in the thin end; a small force in the middle meets the natural frequency, and bends
// the middle by more than that then. The bending stress there is F L / 4 over the section modulus, times
// 1 / (1 - 0.98^2).
TEST(NaturalFrequencies, ResonanceElsewhereThanAtThePeakCounts) {
  const results_test::Directory directory;
  const std::string speed = "600 rpm", keys = "natural_frequencies = 2";
  const auto thin_end = [&](const std::string& at_speed) {
    return with_edits(
        small_shaft({{"torque", "middle.torque", "10 N m", 0}, {"shake", "middle.fy", "20 N", 1}}, "mm",
                    at_speed, keys),
        {{"{ name = \"right\", diameter = \"10 mm\", length = \"188 mm\" },",
          "{ name = \"right\", diameter = \"10 mm\", length = \"178 mm\" },\n { fillet = \"1 mm\" "
          "},\n { name = \"thin\", diameter = \"7 mm\", length = \"10 mm\" },"},
         {"{ port = \"bearing_2\", diameter = \"10 mm\"", "{ port = \"bearing_2\", diameter = \"7 mm\""}});
  };
  const double f1 =
      run_small(directory.path, thin_end(speed))["bodies"]["shaft"]["natural_frequencies"][0]["value"];
  const auto json = run_small(directory.path, thin_end(rpm(0.98 * f1)));
  const auto& shaft = json["bodies"]["shaft"];
  const auto& peak = shaft["peak_von_mises"];
  EXPECT_NE(peak["feature"].get<std::string>().find("thin"), std::string::npos) << peak["feature"];
  const double bending_Pa = 20 * 0.4 / 4 / (M_PI / 32 * 1e-6), true_Pa = bending_Pa / (1 - 0.98 * 0.98);
  ASSERT_GT(true_Pa, 1.5 * peak["value"].get<double>());
  EXPECT_GT(peak["value"].get<double>() + peak["error"]["quasi_static"].get<double>(), true_Pa);
  EXPECT_LT(peak["value"].get<double>() + peak["error"]["quasi_static"].get<double>(), 1.5 * true_Pa);
  EXPECT_NE(shaft["dynamic_amplification"]["place"].get<std::string>().find("middle"), std::string::npos);
  EXPECT_TRUE(warns(json));
}

// The force of order 11, 45 degrees off its crests at 44 instants, asks for more, so that the body is
// superposed once more after its search. What resonance adds, several times the peak, is part of its error
// all the same.
TEST(NaturalFrequencies, ASearchKeepsWhatResonanceAdds) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        small_shaft({{"shake", "middle.fy", "100 N", 3}, {"shake", "middle.fx", "100 N", 11, "45 deg"}}));
  const auto outcome = millstress(
      directory.path, "run scene.toml -o out --tolerance '10 %' --set sampling.instants_per_turn=44");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = summary(directory / "out");
  ASSERT_GT(json["input"]["instants_per_turn"].get<int>(), 44) << "else this test has no case";
  const auto& shaft = json["bodies"]["shaft"];
  const double added = shaft["dynamic_amplification"]["value"].get<double>() - 1;
  ASSERT_GT(added, 2);
  const auto& peak = shaft["peak_von_mises"];
  EXPECT_GE(peak["error"].value("quasi_static", 0.0), 0.99 * added * peak["value"].get<double>());
  EXPECT_NE(json["warnings"].dump().find("NOT KNOWN WELL"), std::string::npos) << json["warnings"];
}

// Not asked for: no stage, no keys, and the rest of the results is the same to the byte.
TEST(NaturalFrequencies, CostNothingUnlessAskedFor) {
  const results_test::Directory directory;
  const std::vector<SmallLoad> loads{{"shake", "middle.fy", "100 N", 1}};
  const auto results = [&](const std::string& keys) {
    auto json = run_small(directory.path, small_shaft(loads, "mm", "300 rpm", keys));
    for (const auto* told : {"hash", "keys"}) json["input"].erase(told);
    json.erase("verdict");  // weighs the resonance
    return json;
  };
  auto with = results("natural_frequencies = 2");
  for (const auto* keys : {"", "natural_frequencies = 0"}) {
    auto without = results(keys);
    EXPECT_FALSE(without["bodies"]["shaft"].contains("natural_frequencies"));
    EXPECT_FALSE(without["bodies"]["shaft"].contains("dynamic_amplification"));
    EXPECT_FALSE(without["timing"].contains("natural frequencies"));
    EXPECT_TRUE(with["timing"].contains("natural frequencies"));
    auto stripped = with;
    for (auto* json : {&stripped, &without}) json->erase("timing");
    stripped["bodies"]["shaft"].erase("natural_frequencies");
    stripped["bodies"]["shaft"].erase("dynamic_amplification");
    auto& error = stripped["bodies"]["shaft"]["peak_von_mises"]["error"];  // the budget has an entry of it
    error["total"] = error["numerical"].get<double>() + error.value("load_patches", 0.0);
    error["methods"].erase("quasi_static");
    EXPECT_EQ(error.erase("quasi_static"), 1u);
    for (auto* json : {&stripped, &without}) {  // what follows from the budget
      json->at("bodies").at("shaft").at("peak_von_mises").at("error").erase("model");
      json->at("bodies").at("shaft").erase("governing");
    }
    EXPECT_EQ(stripped, without);
  }
}

TEST(NaturalFrequencies, MoreThanTheMeshHasAreRefused) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        small_shaft({{"shake", "middle.fy", "100 N", 1}}, "mm", "600 rpm", "natural_frequencies = 51"));
  const auto outcome = millstress(directory.path, "run scene.toml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("natural_frequencies = 51"), std::string::npos) << outcome.err;
}
