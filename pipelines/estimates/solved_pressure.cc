#include "pipelines/estimates/solved_pressure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "pipelines/common/constants.h"
#include "pipelines/superposition/superposition.h"

namespace pipelines {
namespace {

constexpr int most_summed = 256;
/// What the harmonics that were not solved bring follows from the last two that were. On a ring of 60/50 mm under
/// a uniform pressure over 60 degrees the series to n = 4 has 0.94 of the truth (tests/cases/bodies/load_patches.cc).
constexpr double safety_of_tail = 1.25;
/// Round half a seat; a pattern's kinks and jumps lie within a third of a degree of one of them.
constexpr int n_places_around = 512;

/// The largest pressure round the seat, in units of p_1, of a pattern's harmonics from `first` on.
double largest_pressure_from(const PressurePattern& pattern, int first) {
  std::vector<double> c;
  for (int n = 0; n < first; ++n) c.push_back(pattern_coefficient(pattern, n));
  const auto rest = [&](double t) {  // by Clenshaw's recurrence
    const double x = std::cos(t);
    double b1 = 0, b2 = 0;
    for (int n = first - 1; n > 0; --n) b2 = std::exchange(b1, c[std::size_t(n)] + 2 * x * b1 - b2);
    return pattern_pressure(pattern, t) - (c.front() + x * b1 - b2);
  };
  constexpr double beside = 1e-9;
  const double a = pattern.half_angle_rad;
  double most = std::max(std::abs(rest(a * (1 - beside))), std::abs(rest(std::min(pi, a * (1 + beside)))));
  for (int i = 0; i <= n_places_around; ++i) most = std::max(most, std::abs(rest(pi * i / n_places_around)));
  return most;
}

}  // namespace

std::map<std::string, SolvedPressure> solved_pressures(const BodyLoads& loads) {
  std::map<std::string, SolvedPressure> pressures;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto* shape = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape);
    if (shape == nullptr || shape->harmonic == 1) continue;
    const auto& channel = loads.unit_loads[k].channel;
    const std::string port = channel.substr(0, channel.rfind('.'));
    const auto model = loads.pressures.find(port);
    if (model == loads.pressures.end()) continue;
    auto& pressure = pressures[port];
    pressure.model = model->second;
    auto& harmonic = pressure.harmonics[shape->harmonic];
    harmonic.unit = shape->coefficient;
    harmonic.channels.push_back(k);
    if (shape->harmonic != 0) continue;
    // The mean pressure follows the size of the force alone.
    const double factor = solved_coefficient(model->second, 0) / shape->coefficient;
    const auto mean = loads.history.values.row(Eigen::Index(k));
    pressure.force_N = mean.size() > 0 ? mean.abs().maxCoeff() / factor : 0;
  }
  return pressures;
}

double share_of_loads(const BodyLoads& loads, const std::string& port, const Eigen::ArrayXXd& values) {
  double share = 0;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    if (loads.unit_loads[k].channel.rfind(port + ".", 0) != 0) continue;
    const double largest = loads.history.values.row(Eigen::Index(k)).abs().maxCoeff();
    if (largest > 0) share = std::max(share, values.row(Eigen::Index(k)).abs().maxCoeff() / largest);
  }
  return share;
}

StressByHarmonic::StressByHarmonic(const SolvedPressure& pressure,
                                   const std::vector<std::array<double, 6>>& unit_Pa) {
  double mean_Pa = 0;
  for (const auto& [n, harmonic] : pressure.harmonics) {
    double stress_Pa = 0;
    for (const auto k : harmonic.channels) stress_Pa = std::hypot(stress_Pa, von_mises_Pa(unit_Pa[k]));
    stress_Pa *= pressure.force_N / std::abs(harmonic.unit);
    (n == 0 ? mean_Pa : solved_Pa_[n]) = stress_Pa;
  }
  if (solved_Pa_.empty()) {
    const double factor = pressure.model.ring_factor;
    falling_Pa_ = factor > 1 ? 3 * factor * mean_Pa : 0;
    level_Pa_ = mean_Pa;
    return;
  }
  const auto last = std::prev(solved_Pa_.end());
  level_Pa_ = last->second;
  if (last == solved_Pa_.begin()) return;
  const auto before = std::prev(last);
  const double more = last->first * last->first - 1.0, less = before->first * before->first - 1.0;
  level_Pa_ = std::clamp((last->second * more - before->second * less) / (more - less), 0.0, last->second);
  falling_Pa_ = (last->second - level_Pa_) * more;
}

double StressByHarmonic::at(int n) const {
  const auto above = solved_Pa_.lower_bound(n);
  if (above == solved_Pa_.end()) return falling_Pa_ / (n * n - 1.0) + level_Pa_;
  if (above->first == n || above == solved_Pa_.begin()) return above->second;
  return std::max(above->second, std::prev(above)->second);
}

double harmonics_from_Pa(const StressByHarmonic& stress, const PressurePattern& pattern, int first) {
  const auto size = [&](int n) { return std::abs(pattern_coefficient(pattern, n)); };
  double known_Pa = 0;
  int n = std::max(2, first);
  for (; n <= stress.last(); ++n) known_Pa += size(n) * stress.at(n);
  if (!(stress.falling_Pa() + stress.level_Pa() > 0)) return known_Pa;
  const int first_unknown = n;
  double falling = 0, level = 0, last = 0;  // sums, and one of the last terms that is near their largest size
  constexpr int n_last = 16;
  for (; n <= most_summed; ++n) {
    const double c = size(n);
    falling += c / (n * n - 1.0);
    level += c;
    if (n > most_summed - n_last) last = std::max(last, c);
  }
  level += most_summed * last;  // terms that fall like 1 / n^2 have no more left
  if (stress.level_Pa() > 0) level = std::min(level, largest_pressure_from(pattern, first_unknown));
  return known_Pa + safety_of_tail * (falling * stress.falling_Pa() + level * stress.level_Pa());
}

double unsolved_Pa(const StressByHarmonic& stress, const PressurePattern& pattern) {
  double sum_Pa = 0;
  for (int n = 2; n < stress.last(); ++n)
    if (!stress.is_solved(n)) sum_Pa += std::abs(pattern_coefficient(pattern, n)) * stress.at(n);
  return sum_Pa + harmonics_from_Pa(stress, pattern, stress.last() + 1);
}

}  // namespace pipelines
