// Critical speeds of a shaft in a run: those of a bar between two bearings, and what the verdict makes of
// them.
#include <cmath>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

const std::vector<SmallLoad> imbalance{{"imbalance", "middle.fx", "100 N", 0}};

/// Pinned at both ends, order 1: w = (n pi / L)^2 sqrt(E I / rho A), less shear, more rotary inertia, whose
/// sign imbalance turns round (Timoshenko's correction to first order, 2e-4 here).
double pinned_bar_rpm(int n) {
  const double e_Pa = 206e9, rho_kg_m3 = 7850, gyration_m = small_diameter / 4e3;
  const double wave = n * M_PI / (small_span / 1e3), thick = std::pow(wave * gyration_m, 2);
  const double shear = e_Pa / (0.886 * e_Pa / 2.6);
  return wave * wave * gyration_m * std::sqrt(e_Pa / rho_kg_m3) * (1 - thick / 2 * (shear - 1)) * 30 / M_PI;
}

double rpm_of(const nlohmann::json& speed) {
  return speed["speed_rad_s"].get<double>() * 30 / M_PI;
}

nlohmann::json shaft_at(const fs::path& directory, const std::string& speed, const std::string& keys,
                        std::string* out = nullptr) {
  return run_small(directory, small_shaft(imbalance, "mm", speed, keys), out);
}

}  // namespace

// Turns red: the place of a bearing's seat taken for its end (1 %), radii for diameters, rad/s for rpm.
TEST(CriticalSpeeds, OfABarBetweenBearingsAreThoseOfABeam) {
  const results_test::Directory directory;
  std::string text;
  const auto json = shaft_at(directory.path, "600 rpm", "critical_speeds = 2", &text);
  const auto& speeds = json["bodies"]["shaft"]["critical_speeds"];
  ASSERT_EQ(speeds["modes"].size(), 4u);
  for (const int n : {1, 2}) {
    const auto& mode = speeds["modes"][std::size_t(n - 1)];
    EXPECT_NEAR(rpm_of(mode), pinned_bar_rpm(n), 1e-3 * pinned_bar_rpm(n));
    EXPECT_LT(mode["error_rad_s"].get<double>(), 1e-3 * mode["speed_rad_s"].get<double>());
    EXPECT_NEAR(mode["margin"].get<double>(), 600 / rpm_of(mode) - 1, 1e-9);
  }
  EXPECT_EQ(speeds["loads"][0]["order"], 1);
  EXPECT_EQ(speeds["held"], "pinned at bearing_1, bearing_2");
  EXPECT_TRUE(speeds["model_error"].is_null());
  EXPECT_NE(text.find("critical speed rpm"), std::string::npos) << text;
  EXPECT_TRUE(fs::exists(directory / "out/shaft/campbell.csv"));
}

// The solid in the same elastic bearings, at rest: two models of one shaft.
// Turns red: the stiffness of the solid's seats forgotten, or counted twice (a third of the frequency).
TEST(CriticalSpeeds, OfElasticBearingsAreThoseOfTheSolid) {
  const results_test::Directory directory;
  const auto json = shaft_at(directory.path, "600 rpm",
                             "natural_frequencies = 2\ncritical_speeds = 1\n"
                             "bearing_stiffness = [\"50 N/mm\", \"0.1 kN/mm\"]");
  const auto& shaft = json["bodies"]["shaft"];
  const double rigid_Hz = pinned_bar_rpm(1) / 60, solid_Hz = shaft["natural_frequencies"][0]["value"];
  EXPECT_LT(solid_Hz, 0.9 * rigid_Hz);
  EXPECT_LT(shaft["critical_speeds"]["model_error"].get<double>(), 0.005);
  EXPECT_EQ(shaft["critical_speeds"]["held"], "pinned at bearing_1 with 0.05 N/um, bearing_2 with 0.1 N/um");
}

// Turns red: a margin below the critical speed taken for one above, the limit forgotten, a beam that no solid
// was compared with taken for exact.
TEST(CriticalSpeeds, NearTheSpeedAreNotOk) {
  const results_test::Directory directory;
  for (const auto& [share, judgement] :
       {std::pair{0.95, "NOT OK"}, {1.05, "NOT OK"}, {0.87, "NOT JUDGED"}, {0.5, "OK"}}) {
    const auto json =
        shaft_at(directory.path, std::to_string(share * pinned_bar_rpm(1)) + " rpm", "critical_speeds = 1");
    int n_weighed = 0;
    for (const auto& finding : json["verdict"]["parts"]["shaft"]["findings"])
      if (finding["criterion"] == "resonance") {
        ++n_weighed;
        EXPECT_EQ(finding["judgement"], judgement) << finding;
        EXPECT_NEAR(finding["margin"].get<double>(), std::abs(share - 1) / 0.1, 0.02) << finding;
      }
    EXPECT_EQ(n_weighed, 1) << share;
  }
}

// Not asked for: no stage, no keys, no file, and the rest of the results is the same to the last digit.
// Turns red: a stage that runs all the same, a key of it in every summary.
TEST(CriticalSpeeds, CostNothingUnlessAskedFor) {
  const results_test::Directory directory;
  const auto results = [&](const std::string& keys) {
    auto json = shaft_at(directory.path, "300 rpm", keys);
    for (const auto* told : {"hash", "keys"}) json["input"].erase(told);
    json.erase("verdict");  // weighs them
    EXPECT_EQ(json["timing"].contains("critical speeds"), keys == "critical_speeds = 1");
    json.erase("timing");
    return json;
  };
  auto with = results("critical_speeds = 1");
  EXPECT_EQ(with["bodies"]["shaft"].erase("critical_speeds"), 1u);
  for (const auto* keys : {"", "critical_speeds = 0"}) EXPECT_EQ(with, results(keys)) << keys;
}
