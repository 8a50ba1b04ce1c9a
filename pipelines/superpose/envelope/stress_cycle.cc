#include "pipelines/superpose/envelope/stress_cycle.h"

#include <algorithm>
#include <cmath>
#include <utility>
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

/// Pair from one end to the farthest point and on, as long as that grows.
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
/// Fewer are compared each with each.
constexpr std::size_t few_points = 128;

/// Boxes around points, each but the smallest divided in two along its widest side: pairs of boxes that are
/// nowhere so far apart as a known pair of points need no look inside.
class Boxes {
public:
  Boxes(const Deviators& x, std::vector<Index> points) : x_(x), points_(std::move(points)) {
    boxes_.reserve(2 * points_.size() / std::size_t(most_in_box) + 2);
    add(0, Index(points_.size()));
  }

  /// The farthest pair of points, or `known` where none is farther apart by more than the slack.
  Pair farthest(const Pair& known, double slack) {
    best_ = known;
    factor_ = (1 + slack) * (1 + slack) * alike;
    look(0, 0);
    return best_;
  }

private:
  static constexpr Index most_in_box = 8;
  using Corner = Eigen::Array<double, 5, 1>;
  struct Box {
    Index begin, end;             // range of the points
    Index left = -1, right = -1;  // boxes; none: undivided
    Corner low, high;
  };

  Index add(Index begin, Index end) {
    const Index own = Index(boxes_.size());
    Box box{begin, end, -1, -1, x_.col(points_[std::size_t(begin)]).array(), {}};
    box.high = box.low;
    for (Index i = begin; i < end; ++i) {
      box.low = box.low.min(x_.col(points_[std::size_t(i)]).array());
      box.high = box.high.max(x_.col(points_[std::size_t(i)]).array());
    }
    boxes_.push_back(box);
    if (end - begin <= most_in_box) return own;
    Index side = 0;
    (box.high - box.low).maxCoeff(&side);
    const Index middle = (begin + end) / 2;
    std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                     [&](Index a, Index b) { return x_(side, a) < x_(side, b); });
    const Index left = add(begin, middle), right = add(middle, end);
    boxes_[std::size_t(own)].left = left;
    boxes_[std::size_t(own)].right = right;
    return own;
  }

  double most_squared(Index a, Index b) const {
    const Box &one = boxes_[std::size_t(a)], &other = boxes_[std::size_t(b)];
    return (one.high - other.low).abs().max((other.high - one.low).abs()).square().sum();
  }

  void look(Index a, Index b) {
    if (!(most_squared(a, b) > best_.squared * factor_)) return;
    const Box &one = boxes_[std::size_t(a)], &other = boxes_[std::size_t(b)];
    if (one.left < 0 && other.left < 0) {
      for (Index i = one.begin; i < one.end; ++i)
        for (Index j = other.begin; j < other.end; ++j) {
          const Index from = points_[std::size_t(i)], to = points_[std::size_t(j)];
          const double squared = (x_.col(from) - x_.col(to)).squaredNorm();
          if (squared > best_.squared * alike) best_ = {from, to, squared};
        }
      return;
    }
    if (a == b) {
      look(one.left, one.right);
      look(one.left, one.left);
      look(one.right, one.right);
      return;
    }
    const bool first =
        other.left < 0 || (one.left >= 0 && (one.high - one.low).matrix().squaredNorm() >
                                                (other.high - other.low).matrix().squaredNorm());
    const Index kept = first ? b : a, left = first ? one.left : other.left,
                right = first ? one.right : other.right;
    const bool left_first = most_squared(left, kept) >= most_squared(right, kept);
    look(left_first ? left : right, kept);
    look(left_first ? right : left, kept);
  }

  const Deviators& x_;
  std::vector<Index> points_;
  std::vector<Box> boxes_;
  Pair best_;
  double factor_ = 1;
};

/// A pair that beats the known one has a sum of distances from any centre that is larger: from the middle of
/// the known pair few points are so far out. Of many such points, of a circle or of a shape that is about as
/// wide in all directions, boxes tell.
Pair exact_pair(const Deviators& x, Pair best, double slack) {
  const Eigen::Matrix<double, 5, 1> centre = 0.5 * (x.col(best.first) + x.col(best.second));
  const ArrayXd radius = (x.colwise() - centre).colwise().norm().transpose().array();
  const double least = (1 + slack) * std::sqrt(best.squared * alike) - radius.maxCoeff();
  std::vector<Index> order;  // points that may have a partner
  for (Index i = 0; i < x.cols(); ++i)
    if (radius[i] > least) order.push_back(i);
  if (slack > 0 && order.size() > few_points) return Boxes(x, std::move(order)).farthest(best, slack);
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

}  // namespace pipelines
