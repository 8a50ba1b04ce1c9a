#include "kinetics/series/load_spectrum.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

struct Point {
  double value = 0;
  Eigen::Index index = 0;
};

/// A range that was counted.
struct Counted {
  Point from, to;
  double count = 0;
};

LoadCycle cycle_of(const Counted& counted) {
  const double a = counted.from.value, b = counted.to.value;
  return {std::abs(b - a), a / 2 + b / 2, counted.count};
}

enum class StartingPoint { counts_half, counts_full };

/// The three-point rule: counts each range, as soon as the next one is as large, and discards its points.
/// @param start  what a range counts that holds the starting point
/// @param alike  a range counts as large as one that exceeds it by no more
/// @return the points that are left in the end
std::vector<Point> count_ranges(const std::vector<Point>& points, StartingPoint start, double alike,
                                std::vector<Counted>& cycles) {
  std::vector<Point> open;
  for (const Point& point : points) {
    open.push_back(point);
    while (open.size() >= 3) {
      const auto end = open.end();
      const Point a = end[-3], b = end[-2], c = end[-1];
      if (std::abs(c.value - b.value) < std::abs(b.value - a.value) - alike) break;
      const bool half = open.size() == 3 && start == StartingPoint::counts_half;
      cycles.push_back({a, b, half ? 0.5 : 1});
      open.erase(end - 3, half ? end - 2 : end - 1);
    }
  }
  return open;
}

void require_series(const Eigen::ArrayXd& series) {
  if (series.size() == 0)
    throw std::invalid_argument("load series: holds no values; give at least one instant");
  if (series.allFinite()) return;
  for (Eigen::Index i = 0; i < series.size(); ++i)
    require_finite("load series[" + std::to_string(i) + "]", series[i]);
}

/// Peaks and valleys in order, with the first and the last value; equal neighbours count as one.
std::vector<Point> turning_points_of(const Eigen::ArrayXd& series) {
  require_series(series);
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < series.size(); ++i) {
    const double value = series[i];
    const std::size_t n = points.size();
    if (n > 0 && points[n - 1].value == value) continue;
    const bool goes_on =
        n > 1 && (points[n - 1].value > points[n - 2].value) == (value > points[n - 1].value);
    if (goes_on)
      points.back() = {value, i};
    else
      points.push_back({value, i});
  }
  return points;
}

/// Cycles of a period that repeats, counted from one largest value to the next.
std::vector<Counted> count_repeating(const Eigen::ArrayXd& period, double alike) {
  require_series(period);
  Eigen::Index top = 0;
  period.maxCoeff(&top);
  const Eigen::Index n = period.size();
  Eigen::ArrayXd from_top(n + 1);
  from_top << period.tail(n - top), period.head(top), period[top];
  std::vector<Counted> cycles;
  auto points = turning_points_of(from_top);
  for (auto& point : points) point.index = (point.index + top) % n;
  count_ranges(points, StartingPoint::counts_full, alike, cycles);  // closes all: the top is left
  return cycles;
}

}  // namespace

std::vector<LoadCycle> rainflow(const Eigen::ArrayXd& series) {
  std::vector<Counted> counted;
  const auto left = count_ranges(turning_points_of(series), StartingPoint::counts_half, 0, counted);
  for (std::size_t i = 1; i < left.size(); ++i) counted.push_back({left[i - 1], left[i], 0.5});
  std::vector<LoadCycle> cycles;
  for (const auto& one : counted) cycles.push_back(cycle_of(one));
  return cycles;
}

std::vector<LoadCycle> rainflow_repeating(const Eigen::ArrayXd& period) {
  std::vector<LoadCycle> cycles;
  for (const auto& one : count_repeating(period, 0)) cycles.push_back(cycle_of(one));
  return cycles;
}

std::vector<CycleEnds> rainflow_repeating_ends(const Eigen::ArrayXd& period, double alike) {
  require_finite("alike", alike);
  if (alike < 0) refuse("alike", alike, "must not be negative; 0 tells all ranges apart");
  std::vector<CycleEnds> ends;
  for (const auto& [from, to, count] : count_repeating(period, alike))
    if (std::abs(to.value - from.value) > alike)
      ends.push_back({std::min(from.index, to.index), std::max(from.index, to.index)});
  return ends;
}

std::vector<LoadCycle> spectrum(std::vector<LoadCycle> cycles) {
  std::sort(cycles.begin(), cycles.end(), [](const LoadCycle& a, const LoadCycle& b) {
    return std::make_tuple(-a.range, a.mean) < std::make_tuple(-b.range, b.mean);
  });
  std::vector<LoadCycle> merged;
  for (const LoadCycle& cycle : cycles)
    if (!merged.empty() && merged.back().range == cycle.range && merged.back().mean == cycle.mean)
      merged.back().count += cycle.count;
    else
      merged.push_back(cycle);
  return merged;
}

}  // namespace kinetics
