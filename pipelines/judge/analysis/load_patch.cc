#include "pipelines/judge/analysis/load_patch.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/analysis/stress_under_changed_loads.h"
#include "pipelines/judge/estimates/solved_pressure.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

using Pressures = std::map<std::string, SolvedPressure>;

/// Where between the least and the largest half angle patterns are looked at.
constexpr std::array<double, 4> shares_of_range = {0, 1.0 / 3, 2.0 / 3, 1};
/// Share of the stress that harmonics may bring without being solved.
constexpr double felt_share = 1.0 / 500;
const std::string charge_patch = "charge_patch";
/// Share of an entry from which on the range of a port is told.
constexpr double told_share = 0.02;

PressurePattern varied(const PressureModel& model, double share) {
  PressurePattern pattern = model.pattern;
  const auto [least, most] = model.half_angles;
  pattern.half_angle_rad = least + share * (most - least);
  return pattern;
}

bool is_own(const PressureModel& model, const PressurePattern& pattern) {
  return std::abs(pattern.half_angle_rad - model.pattern.half_angle_rad) < 1e-9;
}

/// Change of the channels' factors when a port has another pattern.
void enter_change(const SolvedPressure& pressure, const PressurePattern& pattern, const ArrayXXd& values,
                  ArrayXXd& change) {
  if (is_own(pressure.model, pattern)) return;
  for (const auto& [n, harmonic] : pressure.harmonics) {
    const double own = solved_coefficient(pressure.model, n);
    for (const auto k : harmonic.channels)
      change.row(Index(k)) = values.row(Index(k)) * (pattern_coefficient(pattern, n) / own - 1);
  }
}

/// How much higher and lower a stress may be, both not negative.
struct Rise {
  double up_Pa = 0, down_Pa = 0;
  double most_Pa() const { return std::max(up_Pa, down_Pa); }
  void take(double change_Pa, double unsolved_Pa) {
    up_Pa = std::max(up_Pa, change_Pa + unsolved_Pa);
    down_Pa = std::max(down_Pa, unsolved_Pa - change_Pa);
  }
};

/// The governing point of peak or weld toe.
struct FeltPoint {
  double value_Pa = 0;
  std::vector<std::array<double, 6>> unit_Pa;
  std::map<std::string, StressByHarmonic> harmonics;  // by port

  FeltPoint(const Responded& analysis, const StressPoint& point, double stress_Pa, const Pressures& pressures)
      : value_Pa(stress_Pa), unit_Pa(unit_stress_at(analysis.responses, point)) {
    for (const auto& [port, pressure] : pressures)
      harmonics.emplace(port, StressByHarmonic(pressure, unit_Pa));
  }
  double under(const ArrayXXd& factors) const {
    return largest_von_mises_Pa(unit_Pa.front().data(), factors);
  }
};

FeltPoint peak_of(const Judged& analysis, const Pressures& pressures) {
  return {analysis, {{{analysis.peak.node, 1.0}}, analysis.peak.instant}, analysis.peak.value_Pa, pressures};
}

FeltPoint toe_of(const Judged& analysis, const Pressures& pressures) {
  const auto& spot = analysis.hot_spots.front();
  return {analysis, stress_point(spot), spot.von_mises_Pa, pressures};
}

/// By port, of the place alone.
/// @param values  channels x instants
std::map<std::string, Rise> rise_by_port(const Responded& analysis, const Pressures& pressures,
                                         const FeltPoint& place, const ArrayXXd& values) {
  const double own_Pa = place.under(values);
  std::map<std::string, Rise> result;
  for (const auto& [port, pressure] : pressures) {
    const auto& stress = place.harmonics.at(port);
    const double of_loads = share_of_loads(analysis.loads, port, values);
    for (const double share : shares_of_range) {
      const auto pattern = varied(pressure.model, share);
      if (is_own(pressure.model, pattern)) continue;
      ArrayXXd change = ArrayXXd::Zero(values.rows(), values.cols());
      enter_change(pressure, pattern, values, change);
      result[port].take(place.under(values + change) - own_Pa, of_loads * unsolved_Pa(stress, pattern));
    }
  }
  return result;
}

double unsolved_Pa(const Pressures& pressures, const FeltPoint& place, double share) {
  double sum_Pa = 0;
  for (const auto& [port, pressure] : pressures)
    sum_Pa += unsolved_Pa(place.harmonics.at(port), varied(pressure.model, share));
  return sum_Pa;
}

/// "if main_bearing_1 presses on 80 to 180 degrees in all"
std::string condition_of(const std::map<std::string, Rise>& by_port, const Pressures& pressures,
                         double entry_Pa) {
  std::vector<std::string> ports, ranges;
  for (const auto& [port, rise] : by_port) {
    if (!(rise.most_Pa() > told_share * entry_Pa)) continue;
    const auto& [least, most] = pressures.at(port).model.half_angles;
    const auto range = fmt::format("{:.0f} to {:.0f}", 2 * least * 180 / pi, 2 * most * 180 / pi);
    ports.push_back(port);
    if (std::find(ranges.begin(), ranges.end(), range) == ranges.end()) ranges.push_back(range);
  }
  if (ports.empty()) return "";
  std::string text = ports.size() > 1 ? "if seats press on " : "if " + ports.front() + " presses on ";
  for (std::size_t i = 0; i < ranges.size(); ++i)
    text += (i == 0 ? "" : i + 1 < ranges.size() ? ", " : " or ") + ranges[i];
  return text + " degrees in all";
}

void enter(ErrorBudget& budget, const std::string& source, const Responded& analysis,
           const Pressures& pressures, const FeltPoint& place, Rise rise) {
  const auto by_port = rise_by_port(analysis, pressures, place, analysis.loads.history.values);
  Rise sum;
  for (const auto& [port, of_port] : by_port) {
    sum.up_Pa += of_port.up_Pa;
    sum.down_Pa += of_port.down_Pa;
  }
  rise.up_Pa = std::max({rise.up_Pa, sum.up_Pa, 0.0});
  rise.down_Pa = std::max({rise.down_Pa, sum.down_Pa, 0.0});
  if (!(rise.most_Pa() > 0)) return;
  const auto condition = condition_of(by_port, pressures, rise.most_Pa());
  ErrorEntry entry{
      source,
      fmt::format("{} over other half angles{}: from {:.1f} MPa less to {:.1f} MPa more, with an "
                  "estimate of the harmonics that were not solved",
                  source == charge_patch ? "charge" : "seat pressure",
                  condition.empty() ? "" : ", " + condition, rise.down_Pa / 1e6, rise.up_Pa / 1e6),
      rise.most_Pa()};
  entry.condition = condition;
  budget.set_model(entry);
}

void add_entries(Judged& analysis, const std::string& source, const Pressures& pressures) {
  if (pressures.empty()) return;
  const auto& values = analysis.loads.history.values;
  const auto own = largest_stresses(analysis);
  const auto peak = peak_of(analysis, pressures);
  std::optional<FeltPoint> toe;
  if (!analysis.hot_spots.empty()) toe = toe_of(analysis, pressures);
  Rise of_peak, of_toe;
  for (const double share : shares_of_range) {
    ArrayXXd change = ArrayXXd::Zero(values.rows(), values.cols());
    for (const auto& [port, pressure] : pressures)
      enter_change(pressure, varied(pressure.model, share), values, change);
    if ((change == 0).all()) continue;
    const auto then = largest_under(analysis, change);
    of_peak.take(then.peak_Pa - own.peak_Pa, unsolved_Pa(pressures, peak, share));
    if (toe) of_toe.take(then.hot_spot_Pa - own.hot_spot_Pa, unsolved_Pa(pressures, *toe, share));
  }
  enter(analysis.peak.errors, source, analysis, pressures, peak, of_peak);
  if (toe) enter(analysis.hot_spot_errors, source, analysis, pressures, *toe, of_toe);
}

Pressures that_are(const Pressures& pressures, bool charge) {
  Pressures result;
  for (const auto& [port, pressure] : pressures)
    if (pressure.model.is_charge == charge) result.emplace(port, pressure);
  return result;
}

/// What harmonics up to the third, or the scene's highest one, that were not solved bring at most.
double between_solved_Pa(const SolvedPressure& pressure, const StressByHarmonic& stress) {
  double sum_Pa = 0;
  PressureModel all = pressure.model;
  all.solves_missing = true;
  for (int n = 2; n <= highest_solved(all); ++n) {
    double most = 0;
    if (!stress.is_solved(n))
      for (const double share : shares_of_range)
        most = std::max(most, std::abs(pattern_coefficient(varied(pressure.model, share), n)));
    sum_Pa += most * stress.at(n);
  }
  return sum_Pa;
}

}  // namespace

void add_load_patch_error(Judged& analysis) {
  const auto pressures = solved_pressures(analysis.loads);
  add_entries(analysis, "load_patches", that_are(pressures, false));
  add_entries(analysis, charge_patch, that_are(pressures, true));
}

double load_patch_error_Pa(const Responded& analysis, const StressPoint& point, const ArrayXXd& values) {
  const auto pressures = solved_pressures(analysis.loads);
  if (pressures.empty()) return 0;
  double sum_Pa = 0;
  for (const auto& [port, rise] :
       rise_by_port(analysis, pressures, FeltPoint(analysis, point, 0, pressures), values))
    sum_Pa += std::max(0.0, rise.most_Pa());
  return sum_Pa;
}

std::set<std::string> felt_seats(const Judged& analysis) {
  const auto pressures = solved_pressures(analysis.loads);
  std::set<std::string> ports;
  const auto look_at = [&](const FeltPoint& place) {
    for (const auto& [port, pressure] : pressures)
      if (!pressure.model.solves_missing &&
          between_solved_Pa(pressure, place.harmonics.at(port)) > felt_share * place.value_Pa)
        ports.insert(port);
  };
  if (pressures.empty()) return ports;
  const auto own = largest_stresses(analysis);
  if (analysis.hot_spots.empty() || own.peak_Pa >= own.hot_spot_Pa)
    look_at(peak_of(analysis, pressures));
  else
    look_at(toe_of(analysis, pressures));
  return ports;
}

}  // namespace pipelines
