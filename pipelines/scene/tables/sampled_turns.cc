#include "pipelines/scene/tables/sampled_turns.h"

#include <algorithm>
#include <cmath>

#include "kinetics/table/periodic_cubic.h"
#include "pipelines/base/common/constants.h"

namespace pipelines {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr double full_turn_rad = 2 * pi;

/// Samples before an angle, counted from the first one.
Index n_before(const ArrayXd& angle_rad, double end_rad) {
  const double limit_rad = angle_rad[0] + end_rad - 1e-9 * full_turn_rad;
  return std::lower_bound(angle_rad.data(), angle_rad.data() + angle_rad.size(), limit_rad) -
         angle_rad.data();
}

}  // namespace

double turns_between_ends(const ArrayXd& angle_rad) {
  return (angle_rad[angle_rad.size() - 1] - angle_rad[0]) / full_turn_rad;
}

int whole_turns(const ArrayXd& angle_rad) {
  const Index n = angle_rad.size();
  ArrayXd steps = angle_rad.tail(n - 1) - angle_rad.head(n - 1);
  std::nth_element(steps.begin(), steps.begin() + (n - 1) / 2, steps.end());
  const double usual = steps[(n - 1) / 2] / full_turn_rad;
  return int(std::floor(turns_between_ends(angle_rad) + 1.01 * std::min(usual, 0.5) + 1e-9));
}

MeanTurn mean_turn(const ArrayXd& angle_rad, const ArrayXd& values, int n_turns) {
  const double period_rad = n_turns * full_turn_rad;
  const Index n = n_before(angle_rad, period_rad), n_first = n_before(angle_rad, full_turn_rad);
  const kinetics::table::PeriodicCubic course(angle_rad.head(n), values.head(n), period_rad);
  Eigen::ArrayXXd turns(n_first, n_turns);
  for (int turn = 0; turn < n_turns; ++turn)
    for (Index i = 0; i < n_first; ++i) turns(i, turn) = course(angle_rad[i] + turn * full_turn_rad);
  MeanTurn mean{angle_rad.head(n_first), turns.rowwise().mean(), 0};
  mean.scatter = (turns.colwise() - mean.values).abs().maxCoeff();
  return mean;
}

ArrayXd repeated_angles(const ArrayXd& angle_rad, int n_turns) {
  const Index n = angle_rad.size();
  ArrayXd all(n * n_turns);
  for (int turn = 0; turn < n_turns; ++turn) all.segment(turn * n, n) = angle_rad + turn * full_turn_rad;
  return all;
}

}  // namespace pipelines
