#include "pipelines/analysis/load_patch.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pipelines/analysis/stress_under_changed_loads.h"
#include "pipelines/common/constants.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// The channels of a port's harmonic n: one or two, with what they are solved for.
struct Harmonic {
  double coefficient = 0;
  std::vector<Index> channels;
};

/// A port's pressure: its model, and the harmonics that were solved.
struct Pressure {
  PressureModel model;
  std::map<int, Harmonic> harmonics;
};

std::map<std::string, Pressure> pressures_of(const BodyAnalysis& analysis) {
  std::map<std::string, Pressure> pressures;
  const auto& loads = analysis.loads.unit_loads;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto* shape = std::get_if<fem::SeatPressure>(&loads[k].shape);
    if (shape == nullptr) continue;
    const std::string port = loads[k].channel.substr(0, loads[k].channel.rfind('.'));
    Pressure& pressure = pressures[port];
    PressureModel usual;
    usual.highest_harmonic = analysis.scene.pressure_harmonics;
    const auto own = analysis.scene.pressures.find(port);
    pressure.model = own != analysis.scene.pressures.end() ? own->second : usual;
    Harmonic& harmonic = pressure.harmonics[shape->harmonic];
    harmonic.coefficient = shape->coefficient;
    harmonic.channels.push_back(Index(k));
  }
  return pressures;
}

/// Change of the channels' factors when every pattern reaches `factor` times as far.
ArrayXXd change_by_contact(const BodyAnalysis& analysis, const std::map<std::string, Pressure>& pressures,
                           double factor) {
  const auto& values = analysis.loads.history.values;
  ArrayXXd change = ArrayXXd::Zero(values.rows(), values.cols());
  for (const auto& [port, pressure] : pressures) {
    const auto varied = with_contact(pressure.model.pattern, factor);
    for (const auto& [n, harmonic] : pressure.harmonics)
      for (const Index k : harmonic.channels)
        change.row(k) = values.row(k) * (pattern_coefficient(varied, n) / harmonic.coefficient - 1);
  }
  return change;
}

/// Largest stress at a point from one unit of the coefficient of a harmonic, in whatever direction.
double per_coefficient_Pa(const std::vector<std::array<double, 6>>& unit, const ArrayXXd& values,
                          const Harmonic& harmonic) {
  double stress_Pa = 0, force_N = 0;
  for (const Index k : harmonic.channels)
    stress_Pa = std::hypot(stress_Pa, von_mises_Pa(unit[std::size_t(k)]));
  for (Index i = 0; i < values.cols(); ++i) {
    double now_N = 0;
    for (const Index k : harmonic.channels) now_N = std::hypot(now_N, values(k, i));
    force_N = std::max(force_N, now_N);
  }
  return stress_Pa * force_N / std::abs(harmonic.coefficient);
}

/// What harmonics that were not solved would bring to a point, by their nearest solved neighbours.
double unsolved_Pa(const BodyAnalysis& analysis, const std::map<std::string, Pressure>& pressures,
                   const StressPoint& point, double factor) {
  const auto unit = unit_stress_at(analysis.responses, point);
  double sum_Pa = 0;
  for (const auto& [port, pressure] : pressures) {
    const auto varied = with_contact(pressure.model.pattern, factor);
    const auto& solved = pressure.harmonics;
    // A seat without harmonics above the force lacks at least the second, which ovalises it.
    for (int n = 2; n <= std::max(2, pressure.model.highest_harmonic); ++n) {
      const auto above = solved.lower_bound(n);
      if (above != solved.end() && above->first == n) continue;
      double most_Pa = 0;
      if (above != solved.end())
        most_Pa = per_coefficient_Pa(unit, analysis.loads.history.values, above->second);
      if (above != solved.begin())
        most_Pa = std::max(most_Pa,
                           per_coefficient_Pa(unit, analysis.loads.history.values, std::prev(above)->second));
      sum_Pa += std::abs(pattern_coefficient(varied, n)) * most_Pa;
    }
  }
  return sum_Pa;
}

void enter(ErrorBudget& budget, double change_Pa, double unsolved_Pa) {
  if (change_Pa + unsolved_Pa > 0)
    budget.set_model({"load_patches",
                      std::string("seat pressure over half angles 25 % narrower and wider") +
                          (unsolved_Pa > 0 ? ", harmonics that were not solved by their neighbours" : ""),
                      change_Pa + unsolved_Pa});
}

}  // namespace

PressurePattern with_contact(PressurePattern pattern, double factor) {
  const double half_way = (pattern.half_angle_rad + pi) / 2;
  const double most = pattern.kind == PressurePattern::Kind::uniform ? half_way : pi;
  pattern.half_angle_rad = std::min(factor * pattern.half_angle_rad, most);
  return pattern;
}

void add_load_patch_error(BodyAnalysis& analysis) {
  const auto pressures = pressures_of(analysis);
  if (pressures.empty()) return;
  const auto own = largest_stresses(analysis);
  LargestStresses change, unsolved;
  for (const double factor : {1 - contact_variation, 1 + contact_variation}) {
    const auto varied = largest_under(analysis, change_by_contact(analysis, pressures, factor));
    change.peak_Pa = std::max(change.peak_Pa, std::abs(varied.peak_Pa - own.peak_Pa));
    change.hot_spot_Pa = std::max(change.hot_spot_Pa, std::abs(varied.hot_spot_Pa - own.hot_spot_Pa));
    const StressPoint peak{{{analysis.peak.node, 1.0}}, analysis.peak.instant};
    unsolved.peak_Pa = std::max(unsolved.peak_Pa, unsolved_Pa(analysis, pressures, peak, factor));
    if (!analysis.hot_spots.empty())
      unsolved.hot_spot_Pa =
          std::max(unsolved.hot_spot_Pa,
                   unsolved_Pa(analysis, pressures, stress_point(analysis.hot_spots.front()), factor));
  }
  enter(analysis.peak.errors, change.peak_Pa, unsolved.peak_Pa);
  if (!analysis.hot_spots.empty()) enter(analysis.hot_spot_errors, change.hot_spot_Pa, unsolved.hot_spot_Pa);
}

}  // namespace pipelines
