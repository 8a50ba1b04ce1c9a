#include "kinetics/table/periodic_cubic.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinetics::table {

using Eigen::Index;

PeriodicCubic::PeriodicCubic(Eigen::ArrayXd at, Eigen::ArrayXd values, double period)
    : at_(std::move(at)), values_(std::move(values)), period_(period) {
  const Index n = at_.size();
  at_.conservativeResize(n + 1);
  values_.conservativeResize(n + 1);
  at_[n] = at_[0] + period_;
  values_[n] = values_[0];

  const Eigen::ArrayXd step = at_.tail(n) - at_.head(n);
  const Eigen::ArrayXd secant = (values_.tail(n) - values_.head(n)) / step;
  slopes_.setZero(n + 1);
  for (Index i = 0; i < n; ++i) {
    const Index before = (i + n - 1) % n;
    if (!(secant[before] * secant[i] > 0)) continue;  // an extreme: flat
    const double weight_before = step[before] + 2 * step[i], weight_after = 2 * step[before] + step[i];
    slopes_[i] = (weight_before + weight_after) / (weight_before / secant[before] + weight_after / secant[i]);
  }
  slopes_[n] = slopes_[0];
}

double PeriodicCubic::operator()(double x) const {
  const double shift = std::floor((x - at_[0]) / period_) * period_;
  const double within = std::clamp(x - shift, at_[0], at_[at_.size() - 1]);
  const double* const begin = at_.data();
  const Index last = at_.size() - 2;
  const Index i = std::min<Index>(last, std::upper_bound(begin, begin + at_.size(), within) - begin - 1);
  const double step = at_[i + 1] - at_[i], t = (within - at_[i]) / step, u = 1 - t;
  return values_[i] * u * u * (1 + 2 * t) + values_[i + 1] * t * t * (1 + 2 * u) +
         step * t * u * (slopes_[i] * u - slopes_[i + 1] * t);
}

}  // namespace kinetics::table
