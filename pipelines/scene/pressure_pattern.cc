#include "pipelines/scene/pressure_pattern.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace pipelines {
namespace {

constexpr int n_summed = 4096;

/// sin(k a) / k, a for k = 0.
double sinc(int k, double a) {
  return k == 0 ? a : std::sin(k * a) / k;
}

/// (1/pi) integral over |t| < a of p(t) cos(n t), half of it for n = 0.
double harmonic(const PressurePattern& pattern, int n) {
  const double a = pattern.half_angle_rad, half = n == 0 ? 0.5 : 1;
  if (pattern.kind == PressurePattern::Kind::uniform) return half * 2 / M_PI * sinc(n, a);
  return half / M_PI * (sinc(n - 1, a) + sinc(n + 1, a) - 2 * std::cos(a) * sinc(n, a));
}

void refuse_impossible(const PressurePattern& pattern) {
  const bool uniform = pattern.kind == PressurePattern::Kind::uniform;
  if (pattern.half_angle_rad > 0 && pattern.half_angle_rad <= M_PI &&
      !(uniform && pattern.half_angle_rad > M_PI - 1e-9))
    return;
  throw std::invalid_argument("pressure over a half angle of " +
                              std::to_string(pattern.half_angle_rad * 180 / M_PI) +
                              " degrees: must lie above 0 and " + (uniform ? "below" : "up to") + " 180");
}

}  // namespace

double pattern_coefficient(const PressurePattern& pattern, int n) {
  refuse_impossible(pattern);
  if (n < 0) throw std::invalid_argument("harmonic " + std::to_string(n) + ": must not be negative");
  const double c = harmonic(pattern, n) / harmonic(pattern, 1);
  return std::abs(c) < 1e-14 ? 0 : c;  // what vanishes by symmetry leaves rounding
}

double pattern_value(const PressurePattern& pattern, double t_rad) {
  refuse_impossible(pattern);
  const double t = std::abs(std::remainder(t_rad, 2 * M_PI)), a = pattern.half_angle_rad;
  if (t >= a) return 0;
  const double p = pattern.kind == PressurePattern::Kind::uniform ? 1 : std::cos(t) - std::cos(a);
  return p / harmonic(pattern, 1);
}

double truncation_bound(const PressurePattern& pattern, int highest) {
  const bool full = pattern.kind == PressurePattern::Kind::cosine && pattern.half_angle_rad > M_PI - 1e-9;
  if (full) return 0;
  if (pattern.kind == PressurePattern::Kind::uniform) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (int n = highest + 1; n <= n_summed; ++n) sum += n == 1 ? 0 : std::abs(pattern_coefficient(pattern, n));
  // |p_n| <= (4 / pi) sin(a) ... / n^2: the kinks at +-a; the integral of 1/n^2 beyond n_summed is
  // 1/n_summed.
  const double kink = 2 / M_PI * std::sin(pattern.half_angle_rad) / harmonic(pattern, 1);
  return sum + 2 * std::abs(kink) / n_summed;
}

double truncation_rms(const PressurePattern& pattern, int highest) {
  double sum = 0;
  for (int n = highest + 1; n <= n_summed; ++n) {
    const double c = n == 1 ? 0 : pattern_coefficient(pattern, n);
    sum += n == 0 ? c * c : c * c / 2;
  }
  return std::sqrt(sum);
}

}  // namespace pipelines
