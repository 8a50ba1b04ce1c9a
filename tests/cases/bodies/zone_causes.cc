// What brings each zone, as a run writes it: against runs with one effect alone, and against its own history.
#include <algorithm>
#include <cmath>

#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;
using Columns = std::map<std::string, std::vector<double>>;

const std::vector<std::string> components{"xx", "yy", "zz", "xy", "yz", "xz"};
const SmallLoad pull{"pull", "middle.fy", "100 N", 1}, twist{"twist", "middle.torque", "3 N m"},
    shake{"shake", "middle.torque", "1 N m", 2};

/// As a solid on its own mesh: histories are made of unit responses, and all runs have the same nodes.
std::string solid(const std::vector<SmallLoad>& loads) {
  return "method = \"solid\"\ntolerance = \"none\"\n" + small_shaft(loads, "mm", "600 rpm", "");
}

double sum(const Json& shares) {
  double all = 0;
  for (const auto& [name, share] : shares.items()) all += share.get<double>();
  return all;
}

/// Difference of stress between two instants of a history; from and to equal: the stress itself.
std::vector<double> stress(const Columns& history, std::size_t from, std::size_t to) {
  std::vector<double> s;
  for (const auto& c : components) s.push_back(history.at(c)[to] - (from == to ? 0.0 : history.at(c)[from]));
  return s;
}

/// 3/2 a : dev(b)
double product(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean = (b[0] + b[1] + b[2]) / 3;
  double all = 0;
  for (std::size_t c = 0; c < 6; ++c) all += c < 3 ? a[c] * (b[c] - mean) : 2 * a[c] * b[c];
  return 1.5 * all;
}

std::size_t instant_of(const Json& moment) {
  return std::size_t(std::lround(moment["drive_angle_rad"].get<double>() * 12 / M_PI)) % 24;
}

/// The history at the place of the first zone of `out`, of a scene with some loads.
Columns history_at(const fs::path& directory, const std::vector<SmallLoad>& loads, const Json& position_m) {
  std::string at;
  for (const auto& x : position_m) at += (at.empty() ? "" : ", ") + std::to_string(1e3 * x.get<double>());
  write(directory / "history.toml", solid(loads));
  const auto run = millstress(directory, "history history.toml --json -o h --at '" + at + " mm'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  if (run.exit_code != 0) return {};
  return csv(directory / ("h/" + Json::parse(run.out)["points"][0]["file"].get<std::string>()));
}

}  // namespace

// Loads are in proportion to the sizes of effects, so the part of an effect is the history of a run that has
// it alone: it is what an effect takes along that is switched off.
TEST(ZoneCauses, AreTheStressesOfEachEffectAlone) {
  const results_test::Directory directory;
  std::string printed;
  const auto json = run_small(directory.path, solid({pull, twist, shake}), &printed);
  const auto& zone = json["bodies"]["shaft"]["zones"][0];
  const auto& causes = zone["causes"];
  for (const char* what : {"peak", "amplitude"}) {
    EXPECT_NEAR(sum(causes[what]["effects"]), 1, 1e-12) << what;
    EXPECT_NEAR(sum(causes[what]["channels"]), 1, 1e-12) << what;
    EXPECT_EQ(causes[what]["channels"].size(), json["bodies"]["shaft"]["channels"].size());
    EXPECT_FALSE(causes[what].contains("groups")) << "no group has two of these effects";
  }
  for (const auto& [effect, share] : json["bodies"]["shaft"]["peak_von_mises"]["effect_share"].items())
    EXPECT_NEAR(causes["peak"]["effects"][effect].get<double>(), share.get<double>(), 1e-12) << effect;

  const auto whole = history_at(directory.path, {pull, twist, shake}, zone["position_m"]);
  const std::size_t peak = instant_of(zone), from = instant_of(causes["amplitude"]["from"]),
                    to = instant_of(causes["amplitude"]["to"]);
  const auto at_peak = stress(whole, peak, peak), change = stress(whole, from, to);
  double largest = 0;  // of all pairs
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(largest, product(stress(whole, j, i), stress(whole, j, i)));
  const double amplitude_MPa = causes["amplitude"]["value_Pa"].get<double>() / 1e6;
  EXPECT_NEAR(amplitude_MPa, std::sqrt(largest) / 2, 1e-9 * amplitude_MPa);
  EXPECT_NEAR(std::sqrt(product(change, change)) / 2, amplitude_MPa, 1e-9 * amplitude_MPa);

  std::vector<double> parts(6, 0.0);
  for (const auto& load : {pull, twist, shake}) {
    const auto alone = history_at(directory.path, {load}, zone["position_m"]);
    const auto part = stress(alone, peak, peak), part_of_change = stress(alone, from, to);
    // 1e-9: the same responses up to the solver's rounding, the seats' pressures of other harmonics in both.
    EXPECT_NEAR(causes["peak"]["effects"][load.effect].get<double>(),
                product(part, at_peak) / product(at_peak, at_peak), 1e-9)
        << load.effect;
    EXPECT_NEAR(causes["amplitude"]["effects"][load.effect].get<double>(),
                product(part_of_change, change) / product(change, change), 1e-9)
        << load.effect;
    for (std::size_t c = 0; c < 6; ++c) parts[c] += part[c];
  }
  for (std::size_t c = 0; c < 6; ++c)
    EXPECT_NEAR(parts[c], at_peak[c], 1e-9 * amplitude_MPa) << "the peak's tensor, exactly";
  EXPECT_NEAR(causes["amplitude"]["effects"]["twist"].get<double>(), 0, 1e-9) << "constant";
  EXPECT_NE(printed.find("\n       by pull "), std::string::npos) << printed;
  EXPECT_NE(printed.find("; amplitude "), std::string::npos) << printed;
  const auto page = results_test::bytes(directory / "out/report.html");
  EXPECT_NE(page.find("brought by"), std::string::npos);
}

// A pull that is a tenth of a percent smaller: the amplitude falls by that times its share, to second order.
TEST(ZoneCauses, PredictASmallerEffectToFirstOrder) {
  const results_test::Directory directory;
  const auto zone_of = [&](const std::string& size) {
    const auto json = run_small(directory.path, solid({{"pull", "middle.fy", size, 1}, twist, shake}));
    return json["bodies"]["shaft"]["zones"][0];
  };
  const auto whole = zone_of("100 N"), less = zone_of("99.9 N");
  ASSERT_EQ(whole["position_m"], less["position_m"]);
  const auto amplitude = [](const Json& zone) {
    return zone["causes"]["amplitude"]["value_Pa"].get<double>();
  };
  const double fall = 1 - amplitude(less) / amplitude(whole);
  EXPECT_NEAR(fall, 1e-3 * whole["causes"]["amplitude"]["effects"]["pull"].get<double>(), 2e-6);
  EXPECT_GT(fall, 5e-4);
  const double peak_fall =
      1 - less["peak_von_mises_Pa"].get<double>() / whole["peak_von_mises_Pa"].get<double>();
  EXPECT_NEAR(peak_fall, 1e-3 * whole["causes"]["peak"]["effects"]["pull"].get<double>(), 2e-6);
}

// Numbers, peaks and levels of zone_tree.csv against zones.csv and summary.json.
TEST(ZoneCauses, TheTreeHoldsTheZonesAndTheirParts) {
  const results_test::Directory directory;
  const auto json = run_small(directory.path, solid({pull, twist, shake}));
  const auto& zones = json["bodies"]["shaft"]["zones"];
  const auto tree = csv(directory / "out/shaft/zone_tree.csv");
  const auto table = csv(directory / "out/shaft/zones.csv");
  std::istringstream text(results_test::bytes(directory / "out/shaft/zone_tree.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line,
            "zone,level [MPa],feature,place,peak_von_mises [MPa],turn,drive_angle [deg],x [mm],y [mm],z "
            "[mm],nodes");
  std::size_t row = 0;
  const double body_peak = zones[0]["peak_von_mises_Pa"], MPa = 1e6, digits = 1e-14;
  const auto next = [&](const std::string& number, double level_Pa, double peak_Pa, double nodes) {
    ASSERT_TRUE(std::getline(text, line));
    EXPECT_EQ(line.substr(0, line.find(',')), number);
    EXPECT_NEAR(tree.at("level")[row] * MPa, level_Pa, digits * level_Pa) << number;
    EXPECT_NEAR(tree.at("peak_von_mises")[row] * MPa, peak_Pa, digits * peak_Pa) << number;
    EXPECT_EQ(tree.at("nodes")[row], nodes) << number;
    ++row;
  };
  std::size_t n_parts = 0;
  for (std::size_t z = 0; z < zones.size(); ++z) {
    EXPECT_EQ(zones[z]["zone"], z + 1);
    EXPECT_EQ(table.at("zone")[z], double(z + 1));
    EXPECT_EQ(table.at("peak_von_mises")[z], tree.at("peak_von_mises")[row]);
    next(std::to_string(z + 1), json["bodies"]["shaft"]["zone_level"]["value"].get<double>(),
         zones[z]["peak_von_mises_Pa"].get<double>(), table.at("nodes")[z]);
    if (!zones[z].contains("parts")) continue;
    for (const auto& part : zones[z]["parts"]) {
      const auto number = part["zone"].get<std::string>();
      EXPECT_EQ(number.substr(0, number.find('.')), std::to_string(z + 1));
      const auto depth = std::count(number.begin(), number.end(), '.');
      EXPECT_NEAR(part["level_Pa"].get<double>(), (depth == 1 ? 0.7 : 0.9) * body_peak, 1e-9 * body_peak);
      EXPECT_LE(part["nodes"].get<double>(), table.at("nodes")[z]);
      next(number, part["level_Pa"].get<double>(), part["peak_von_mises_Pa"].get<double>(),
           part["nodes"].get<double>());
      ++n_parts;
    }
  }
  EXPECT_EQ(row, tree.at("zone").size());
  EXPECT_GE(n_parts, 2u);
  EXPECT_EQ(zones[0]["parts"][0]["peak_von_mises_Pa"], zones[0]["peak_von_mises_Pa"]);
}
