#include "kinetics/planetary_effects/segment.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/constants.h"

namespace kinetics::planetary {
namespace {

constexpr double pi_beyond_double = 1.2246467991473532e-16;  // what the double `pi` lacks

/// 6 (x - sin x) / x^3 = 1 - x^2/20 (1 - x^2/42 (1 - x^2/72 (...))); for x < 1.5 ten terms are exact.
double cubic_series(double x) {
  double sum = 1;
  for (int k = 11; k >= 2; --k) sum = 1 - x * x / (2.0 * k * (2.0 * k + 1)) * sum;
  return sum;
}

/// pi - angle, with the digits of pi that a double lacks.
double to_pi(double angle_rad) {
  return (pi - angle_rad) + pi_beyond_double;
}

/// The segment whose smaller part takes this share of the circle.
Segment split(double share, double half_rad, bool share_is_filled) {
  if (share_is_filled) return {half_rad, to_pi(half_rad), share, std::sin(half_rad)};
  return {to_pi(half_rad), half_rad, 1 - share, std::sin(half_rad)};
}

}  // namespace

double x_minus_sin(double x) {
  return x < 1.5 ? x * x * x / 6 * cubic_series(x) : x - std::sin(x);
}

double angle_of_share(double share) {
  const double M = 2 * pi * share;
  double low = std::cbrt(6 * M), high = std::cbrt(pi * pi * M);  // x^3/pi^2 <= x - sin x <= x^3/6
  const double s = low, s2 = s * s;
  double x = s * (1 + s2 / 60 * (1 + s2 * 3 / 70));
  if (s < 1e-3) return x;
  for (int i = 0; i < 60; ++i) {
    const double miss = x_minus_sin(x) - M;
    (miss > 0 ? high : low) = x;
    const double half_sine = std::sin(x / 2);
    double next = x - miss / (2 * half_sine * half_sine);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const bool settled = std::abs(next - x) <= 1e-16 * x;
    x = next;
    if (settled) break;
  }
  return std::min(x, pi);
}

Segment segment_of_half_angle(double half_angle_rad) {
  const bool lower = half_angle_rad <= pi / 2;
  const double half_rad = lower ? half_angle_rad : std::max(0.0, to_pi(half_angle_rad));
  return split(x_minus_sin(2 * half_rad) / (2 * pi), half_rad, lower);
}

Segment segment_of_filling(double filling) {
  const bool lower = filling <= 0.5;
  const double share = lower ? filling : 1 - filling;
  return split(share, angle_of_share(share) / 2, lower);
}

Segment segment_of_void(double void_fraction) {
  const bool upper = void_fraction <= 0.5;
  const double share = upper ? void_fraction : 1 - void_fraction;
  return split(share, angle_of_share(share) / 2, !upper);
}

double centroid_distance(const Segment& segment) {
  const double gamma = segment.half_angle_rad, sine = segment.sine;
  if (gamma == 0) return 1;
  if (gamma < 0.75) return std::pow(sine / gamma, 3) / cubic_series(2 * gamma);
  return 2 * sine * sine * sine / (3 * pi * segment.filling);
}

}  // namespace kinetics::planetary
