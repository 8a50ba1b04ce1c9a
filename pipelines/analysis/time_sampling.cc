#include "pipelines/analysis/time_sampling.h"

#include <algorithm>
#include <cmath>

#include "pipelines/analysis/error_budget.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

/// Below so many instants the whole cycle counts.
constexpr Index few = 16;
/// Instants of a polynomial: of a harmonic with eight instants per period it misses 2e-4.
constexpr Index n_nodes = 8;
/// Places looked at between an instant and its neighbour.
constexpr int n_between = 8;

/// The share of an instant `away` from the place, in steps, in the trigonometric polynomial of n instants.
double trigonometric_share(double away, Index n) {
  const double angle = M_PI * away / double(n);
  const double kernel = std::sin(M_PI * away) / (double(n) * std::sin(angle));
  return n % 2 == 0 ? kernel * std::cos(angle) : kernel;
}

/// The factors at instant + offset, |offset| < 1 and not 0.
ArrayXd factors_between(const ArrayXXd& values, Index instant, double offset) {
  const Index n = values.cols();
  ArrayXd factors = ArrayXd::Zero(values.rows());
  if (n < few) {
    for (Index i = 0; i < n; ++i)
      factors += trigonometric_share(double(instant - i) + offset, n) * values.col(i);
    return factors;
  }
  const Index first = (offset > 0 ? 0 : -1) - n_nodes / 2 + 1;
  for (Index i = first; i < first + n_nodes; ++i) {
    double share = 1;
    for (Index other = first; other < first + n_nodes; ++other)
      if (other != i) share *= (offset - double(other)) / double(i - other);
    factors += share * values.col((instant + i + n) % n);
  }
  return factors;
}

/// What the crest of the parabola through three equidistant values exceeds the middle one by.
double parabola_excess(double before, double here, double after) {
  const double curvature = before - 2 * here + after;
  return curvature < 0 ? (before - after) / (-8 * curvature) * (before - after) : 0;
}

}  // namespace

double time_sampling_error_Pa(const std::vector<std::array<double, 6>>& unit, const ArrayXXd& values,
                              Index instant) {
  const Index n = values.cols();
  // The cycle is periodic, so the neighbours of the first and last instant are each other.
  const double before = von_mises_of(unit, values.col((instant + n - 1) % n));
  const double here = von_mises_of(unit, values.col(instant));
  const double after = von_mises_of(unit, values.col((instant + 1) % n));
  const double parabola = parabola_excess(before, here, after);
  if (n < 3) return parabola;

  std::array<double, 2 * n_between + 1> between{};  // from one neighbour to the other
  between.front() = before, between[n_between] = here, between.back() = after;
  for (int i = 1; i < 2 * n_between; ++i)
    if (i != n_between)
      between[std::size_t(i)] =
          von_mises_of(unit, factors_between(values, instant, double(i - n_between) / n_between));
  const auto crest = std::size_t(std::max_element(between.begin() + 1, between.end() - 1) - between.begin());
  const double excess =
      between[crest] - here + parabola_excess(between[crest - 1], between[crest], between[crest + 1]);
  return std::max(parabola, excess);
}

}  // namespace pipelines
