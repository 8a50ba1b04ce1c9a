#include "pipelines/judge/estimates/solved_pressure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

constexpr int most_summed = 256;
/// Round half a seat; a pattern's kinks and jumps lie within a third of a degree of one of them.
constexpr int n_places_around = 512;

Stress sum(const Stress& a, double factor, const Stress& b) {
  Stress result;
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = a[c] + factor * b[c];
  return result;
}

Stress scaled(const Stress& a, double factor) {
  return sum(Stress{}, factor, a);
}

/// The inner product whose norm is the von Mises stress.
double product(const Stress& a, const Stress& b) {
  const double more = von_mises_Pa(sum(a, 1, b)), less = von_mises_Pa(sum(a, -1, b));
  return (more * more - less * less) / 4;
}

/// Where the angle counts from is of no account: the stress of a harmonic's cosine and sine at a point at
/// theta are
///   cos(n theta) u + sin(n theta) v  and  sin(n theta) u - cos(n theta) v,
/// u the stress on the planes of symmetry, v the shear across them. No stress of u is one of v, so that they
/// are the principal axes of both.
struct Amplitudes {
  Stress u{}, v{};  ///< the larger one first
};

Amplitudes amplitudes_of(const Stress& cosine, const Stress& sine) {
  const double angle =
      std::atan2(2 * product(cosine, sine), product(cosine, cosine) - product(sine, sine)) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  return {sum(scaled(cosine, c), s, sine), sum(scaled(sine, c), -s, cosine)};
}

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
  std::map<int, Amplitudes> amplitudes;
  for (const auto& [n, harmonic] : pressure.harmonics) {
    const double factor = pressure.force_N / std::abs(harmonic.unit);
    const auto stress_Pa = [&](std::size_t phase) {
      return phase < harmonic.channels.size() ? scaled(unit_Pa[harmonic.channels[phase]], factor) : Stress{};
    };
    const auto cosine_Pa = stress_Pa(0), sine_Pa = stress_Pa(1);
    const double both_Pa = std::hypot(von_mises_Pa(cosine_Pa), von_mises_Pa(sine_Pa));
    (n == 0 ? mean_Pa : solved_Pa_[n]) = both_Pa;
    if (n > 0) amplitudes[n] = amplitudes_of(cosine_Pa, sine_Pa);
  }
  if (solved_Pa_.empty()) {
    const double factor = pressure.model.ring_factor;
    falling_Pa_ = factor > 1 ? 3 * factor * mean_Pa : 0;
    level_Pa_ = mean_Pa;
    return;
  }
  const auto last = std::prev(amplitudes.end());
  level_Pa_ = solved_Pa_.rbegin()->second;
  if (last == amplitudes.begin()) return;
  const auto before = std::prev(last);
  const double more = last->first * last->first - 1.0, less = before->first * before->first - 1.0;
  const auto go_on = [&](Stress from, const Stress& to) {
    if (product(from, to) < 0) from = scaled(from, -1);
    auto level = scaled(sum(scaled(to, more), -less, from), 1 / (more - less));
    // What falls faster, away from the seat, has no level above what was solved last.
    const double level_Pa = von_mises_Pa(level), last_Pa = von_mises_Pa(to);
    if (level_Pa > last_Pa) level = scaled(level, last_Pa / level_Pa);
    level_Pa_ = std::hypot(level_Pa_, von_mises_Pa(level));
    falling_Pa_ = std::hypot(falling_Pa_, more * von_mises_Pa(sum(to, -1, level)));
  };
  level_Pa_ = 0;
  go_on(before->second.u, last->second.u);
  go_on(before->second.v, last->second.v);
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
  return known_Pa + falling * stress.falling_Pa() + level * stress.level_Pa();
}

double unsolved_Pa(const StressByHarmonic& stress, const PressurePattern& pattern) {
  double sum_Pa = 0;
  for (int n = 2; n < stress.last(); ++n)
    if (!stress.is_solved(n)) sum_Pa += std::abs(pattern_coefficient(pattern, n)) * stress.at(n);
  return sum_Pa + harmonics_from_Pa(stress, pattern, stress.last() + 1);
}

}  // namespace pipelines
