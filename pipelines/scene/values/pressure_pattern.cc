#include "pipelines/scene/values/pressure_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

/// sin(k a) / k, a for k = 0. Beyond 90 degrees by the opening pi - a, of which k a would lose the digits.
double sinc(int k, double a) {
  constexpr double pi_beyond_double = 1.2246467991473532e-16;
  if (k == 0) return a;
  if (a <= pi / 2) return std::sin(k * a) / k;
  return (k % 2 == 0 ? -1 : 1) * std::sin(k * ((pi - a) + pi_beyond_double)) / k;
}

/// Integral over |t| < a of (cos t - cos a) cos(n t), n a up to 1.5: the closed form is the rest of terms
/// that cancel like a^2, the integrand is a product without signs. Gauss's rule of ten points is exact to
/// rounding.
double narrow_cosine_integral(double a, int n) {
  constexpr std::array<double, 5> x{0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                    0.8650633666889845, 0.9739065285171717},
      w{0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806, 0.0666713443086881};
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += w[i] * 2 * std::sin(a * (1 + x[i]) / 2) * std::sin(a * (1 - x[i]) / 2) * std::cos(n * a * x[i]);
  return 2 * a * sum;
}

/// (1/pi) integral over |t| < a of p(t) cos(n t), half of it for n = 0.
double harmonic(const PressurePattern& pattern, int n) {
  const double a = pattern.half_angle_rad, half = n == 0 ? 0.5 : 1;
  if (pattern.kind == PressurePattern::Kind::uniform) return half * 2 / pi * sinc(n, a);
  if (std::max(1, n) * a <= 1.5) return half / pi * narrow_cosine_integral(a, n);
  if (n == 0) return (std::sin(a) - a * std::cos(a)) / pi;
  return (sinc(n - 1, a) - sinc(n + 1, a)) / (pi * n);  // by parts: fewer terms that cancel
}

void refuse_impossible(const PressurePattern& pattern) {
  const bool uniform = pattern.kind == PressurePattern::Kind::uniform;
  if (pattern.half_angle_rad > 0 && pattern.half_angle_rad <= pi &&
      !(uniform && pattern.half_angle_rad > pi - 1e-9))
    return;
  throw std::invalid_argument("pressure over a half angle of " +
                              std::to_string(pattern.half_angle_rad * 180 / pi) +
                              " degrees: must lie above 0 and " + (uniform ? "below" : "up to") + " 180");
}

}  // namespace

double middle_of(const std::vector<double>& axial_profile) {
  if (axial_profile.size() < 2) return 0;
  const double step = 2.0 / double(axial_profile.size() - 1);
  double whole = 0, moment = 0;
  for (std::size_t i = 0; i + 1 < axial_profile.size(); ++i) {  // straight lines
    const double begin = -1 + double(i) * step, a = axial_profile[i], b = axial_profile[i + 1];
    whole += (a + b) / 2;
    moment += begin * (a + b) / 2 + step * (a + 2 * b) / 6;
  }
  const double middle = moment / whole;
  return std::abs(middle) < 1e-12 ? 0 : middle;
}

double pattern_coefficient(const PressurePattern& pattern, int n) {
  refuse_impossible(pattern);
  if (n < 0) throw std::invalid_argument("harmonic " + std::to_string(n) + ": must not be negative");
  const double c = harmonic(pattern, n) / harmonic(pattern, 1);
  return std::abs(c) < 1e-14 ? 0 : c;  // what vanishes by symmetry leaves rounding
}

double pattern_pressure(const PressurePattern& pattern, double t_rad) {
  refuse_impossible(pattern);
  const double a = pattern.half_angle_rad, t = std::abs(std::remainder(t_rad, 2 * pi));
  if (t > a) return 0;
  const bool uniform = pattern.kind == PressurePattern::Kind::uniform;
  return (uniform ? 1 : 2 * std::sin((a + t) / 2) * std::sin((a - t) / 2)) / harmonic(pattern, 1);
}

HalfAngles half_angles_around(const PressurePattern& pattern) {
  const double a = pattern.half_angle_rad;
  const double most = pattern.kind == PressurePattern::Kind::uniform ? (a + pi) / 2 : pi;
  return {(1 - half_angle_share) * a, std::min((1 + half_angle_share) * a, most)};
}

int highest_solved(const PressureModel& model) {
  constexpr int least = 3;  // two harmonics tell how the response decays
  return model.solves_missing ? std::max(model.highest_harmonic, least) : model.highest_harmonic;
}

double solved_coefficient(const PressureModel& model, int n) {
  if (n == 1 || n > highest_solved(model)) return 0;
  const double c = n <= model.highest_harmonic ? pattern_coefficient(model.pattern, n) : 0;
  return c == 0 && model.solves_missing ? missing_coefficient : c;
}

}  // namespace pipelines
