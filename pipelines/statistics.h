/// Largest, smallest, mean and RMS of a series over its instants.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pipelines {

struct Statistics {
  double max = 0, min = 0, mean = 0, rms = 0;
};

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
    s.rms += value * value;
    ++n;
  }
  if (n > 0) {
    s.mean /= double(n);
    s.rms = std::sqrt(s.rms / double(n));
  }
  return s;
}

}  // namespace pipelines
