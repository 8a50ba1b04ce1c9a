#include "pipelines/superposition/stress_cycle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

using Deviators = Eigen::Matrix<double, 5, Eigen::Dynamic>;

/// Coordinates of the deviators in which the distance of two stresses is the von Mises stress of their
/// difference: an orthonormal basis of the five-dimensional space, times sqrt(3/2).
Deviators deviator_coordinates(const ArrayXXd& stress) {
  Deviators x(5, stress.cols());
  const double third = std::sqrt(3.0);
  x.row(0) = (stress.row(0) - 0.5 * (stress.row(1) + stress.row(2))).matrix();
  x.row(1) = (0.5 * third * (stress.row(1) - stress.row(2))).matrix();
  for (Index c = 0; c < 3; ++c) x.row(2 + c) = (third * stress.row(3 + c)).matrix();
  return x;
}

/// The instant farthest from a point.
Index farthest(const Deviators& x, const Eigen::Matrix<double, 5, 1>& from) {
  Index instant = 0;
  (x.colwise() - from).colwise().squaredNorm().maxCoeff(&instant);
  return instant;
}

struct Pair {
  Index first = 0, second = 0;
  double squared = 0;  ///< distance
};

/// From one end to the farthest point and on, as long as that grows.
Pair pair_by_hops(const Deviators& x, Index start) {
  Pair pair{start, start, 0};
  while (true) {
    const Index other = farthest(x, x.col(pair.second));
    const double squared = (x.col(other) - x.col(pair.second)).squaredNorm();
    if (!(squared > pair.squared)) return pair;
    pair = {pair.second, other, squared};
  }
}

/// Differences below this share of the squared diameter are rounding: pairs of a circle are all alike.
constexpr double alike = 1 + 1e-12;

/// A pair that beats the known one has a sum of distances from any centre that is larger: from the middle of
/// the known pair few points are so far out.
Pair exact_pair(const Deviators& x, Pair best, double slack) {
  const Eigen::Matrix<double, 5, 1> centre = 0.5 * (x.col(best.first) + x.col(best.second));
  const ArrayXd radius = (x.colwise() - centre).colwise().norm().transpose().array();
  const double least = (1 + slack) * std::sqrt(best.squared * alike) - radius.maxCoeff();
  std::vector<Index> order;  // of those that may have a partner
  for (Index i = 0; i < x.cols(); ++i)
    if (radius[i] > least) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return radius[a] > radius[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double wanted = (1 + slack) * std::sqrt(best.squared * alike);
    if (2 * radius[order[i]] <= wanted) break;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (radius[order[i]] + radius[order[j]] <= wanted) break;
      const double squared = (x.col(order[i]) - x.col(order[j])).squaredNorm();
      if (squared > best.squared * alike) best = {order[i], order[j], squared};
    }
  }
  return best;
}

}  // namespace

double signed_von_mises_Pa(const Stress& s) {
  const double size = von_mises_Pa(s), trace = s[0] + s[1] + s[2];
  return std::clamp(size + 2 * std::min(trace, 0.0), -size, size);
}

Stress signed_von_mises_slopes(const Stress& s) {
  Stress slopes{};
  const double size = von_mises_Pa(s), trace = s[0] + s[1] + s[2];
  if (!(size > 0)) return slopes;
  const bool is_compression = trace <= -size, is_between = trace < 0 && !is_compression;
  for (std::size_t c = 0; c < 6; ++c) {
    slopes[c] = (c < 3 ? 1.5 * (s[c] - trace / 3) : 3 * s[c]) / size;
    if (is_compression) slopes[c] = -slopes[c];
    if (is_between && c < 3) slopes[c] += 2;
  }
  return slopes;
}

StressCycle cycle_between(const Stress& from, const Stress& to, Index first, Index second) {
  StressCycle cycle;
  cycle.from = std::min(first, second);
  cycle.to = std::max(first, second);
  const double sign = first <= second ? 1 : -1;
  for (std::size_t c = 0; c < 6; ++c) {
    cycle.half_range_Pa[c] = sign * 0.5 * (to[c] - from[c]);
    cycle.mean_Pa[c] = 0.5 * (to[c] + from[c]);
  }
  cycle.amplitude_Pa = von_mises_Pa(cycle.half_range_Pa);
  cycle.signed_mean_Pa = signed_von_mises_Pa(cycle.mean_Pa);
  return cycle;
}

StressCycle largest_cycle(const ArrayXXd& stress_Pa, double slack) {
  const double size = stress_Pa.abs().maxCoeff();
  const Deviators x = deviator_coordinates(size > 0 ? ArrayXXd(stress_Pa / size) : stress_Pa);
  Index start = 0;
  x.colwise().squaredNorm().maxCoeff(&start);
  const Pair pair = exact_pair(x, pair_by_hops(x, start), slack);
  const auto at = [&](Index instant) {
    Stress s{};
    for (std::size_t c = 0; c < 6; ++c) s[c] = stress_Pa(Index(c), instant);
    return s;
  };
  return cycle_between(at(pair.first), at(pair.second), pair.first, pair.second);
}

ArrayXd along_cycle_Pa(const ArrayXXd& stress_Pa, const StressCycle& cycle) {
  ArrayXd along = ArrayXd::Zero(stress_Pa.cols());
  if (!(cycle.amplitude_Pa > 0)) return along;
  const auto& r = cycle.half_range_Pa;
  const double mean = (r[0] + r[1] + r[2]) / 3;
  for (Index c = 0; c < 6; ++c)
    along += 1.5 / cycle.amplitude_Pa * (c < 3 ? r[std::size_t(c)] - mean : 2 * r[std::size_t(c)]) *
             stress_Pa.row(c).transpose();
  return along;
}

}  // namespace pipelines
