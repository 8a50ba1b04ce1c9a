/// Largest, smallest, mean and RMS of a series over its instants.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace pipelines {

struct Statistics {
  double max = 0, min = 0, mean = 0, rms = 0;
};

/// Root mean square of a finite series, scaled by its largest entry so that no square overflows.
inline double root_mean_square(const Eigen::ArrayXd& values) {
  const double largest = values.size() > 0 ? values.abs().maxCoeff() : 0;
  return largest > 0 ? largest * std::sqrt((values / largest).square().mean()) : 0;
}

/// Instants that are not finite (a quotient where its divisor passes through zero) do not count; all zero if
/// none does.
inline Statistics statistics(const Eigen::ArrayXd& values) {
  Statistics s;
  Eigen::Index n = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    s.max = n == 0 ? value : std::max(s.max, value);
    s.min = n == 0 ? value : std::min(s.min, value);
    s.mean += value;
    s.rms = std::max(s.rms, std::abs(value));  // the largest, so far
    ++n;
  }
  if (n > 0) {
    s.mean /= double(n);
    double squares = 0;
    for (const double value : values)
      if (std::isfinite(value) && s.rms > 0) squares += (value / s.rms) * (value / s.rms);
    s.rms *= std::sqrt(squares / double(n));
  }
  return s;
}

/// What rounding leaves of a mean that is none, shown as 0.
/// @param scale  largest size of the series
inline double without_rounding(double mean, double scale) {
  constexpr double rounding = 1e-13;
  return std::abs(mean) < rounding * scale ? 0.0 : mean;
}

}  // namespace pipelines
