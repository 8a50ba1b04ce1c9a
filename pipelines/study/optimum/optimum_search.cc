#include "pipelines/study/optimum/optimum_search.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "pipelines/base/common/errors.h"
#include "pipelines/scene/values/requested_accuracy.h"
#include "pipelines/study/optimum/cobyla.h"

namespace pipelines {
namespace {

/// Ends a search once as many points were evaluated as were asked for.
struct EvaluationsUsedUp {};

constexpr double first_step = 0.25, sharper_step = 0.05, step_beside = 0.05;
/// An error below this share of a bound is not worth a sharper solve.
constexpr double error_that_matters = 2e-3;
/// A sharper solve is gone on with where it leaves less than this share of the error.
constexpr double lower_error = 0.8;

/// The value of a coordinate from 0 to 1, with few digits.
double number_at(const ValueRange& range, double x) {
  const double low = std::min(range.first, range.last), high = std::max(range.first, range.last);
  const double scale = std::pow(10.0, 4 - std::floor(std::log10(high - low)));
  const double number = range.first + x * (range.last - range.first);
  return std::clamp(std::round(number * scale) / scale, low, high);
}

double coordinate_of(const ValueRange& range, double number) {
  return std::clamp((number - range.first) / (range.last - range.first), 0.0, 1.0);
}

/// COBYLA ends near a bound, to either side: it is given one that is closer by this share.
constexpr double margin_of_bounds = 1e-3;

class PathSearch {
public:
  PathSearch(const OptimumRequest& request, const OptimumSearch& given) : request_(request), given_(given) {
    result_.plan.variations = request.variations;
    if (!(given.tolerance > 0)) return;
    Variation tolerance;
    tolerance.key = "tolerance";
    result_.plan.variations.push_back(tolerance);
  }

  Optimum run() {
    std::vector<double> start;
    for (std::size_t v = 0; v < given_.start.size(); ++v)
      start.push_back(coordinate_of(*request_.variations[v].range, given_.start[v]));
    result_.has_converged = minimise(start, first_step, 0);
    require_any_row();
    std::size_t level = 0;
    if (given_.tolerance > 0 && needs_sharper_solve(best_at(0))) {
      sharper_ = sharper_tolerance(result_.rows[best_at(0)]);
      const auto before = best_at(0), again = evaluate(coordinates(before), 1);
      if (!is_refused(again) && (lacking(again) > 0 || has_less_error(before, again))) {
        level = 1;
        result_.has_converged = minimise(coordinates(before), sharper_step, 1);
      }
    }
    result_.best = best_at(level);
    result_.is_kept = lacking(result_.best) <= 0;
    result_.beside.resize(request_.variations.size());
    if (result_.is_kept) evaluate_beside(level);
    return std::move(result_);
  }

private:
  /// @return whether it converged
  bool minimise(const std::vector<double>& start, double step, std::size_t level) {
    CobylaProblem problem{start, step, 1e-3, request_.bounds.size(),
                          [&](const std::vector<double>& x) { return trial_of(evaluate(x, level, true)); }};
    try {
      run_cobyla(problem);
      close_in(level);
    } catch (const EvaluationsUsedUp&) {
      return false;
    }
    return true;
  }

  /// Goes from the best point towards one that is better and lacks least, up to where a bound is just kept.
  void close_in(std::size_t level) {
    constexpr int most_steps = 3;
    for (int i = 0; i < most_steps; ++i) {
      const auto kept = best_at(level);
      const double left = -lacking(kept);
      if (left < 0 || left <= 2 * margin_of_bounds) return;
      std::optional<std::size_t> beyond;
      for (std::size_t p = 0; p < result_.rows.size(); ++p)
        if (result_.levels[p] == level && !is_refused(p) && goal(p) < goal(kept) &&
            (!beyond || lacking(p) < lacking(*beyond)))
          beyond = p;
      if (!beyond) return;
      const double way = (left - margin_of_bounds) / (left + lacking(*beyond));
      auto x = coordinates(kept);
      const auto end = coordinates(*beyond);
      for (std::size_t v = 0; v < x.size(); ++v) x[v] += way * (end[v] - x[v]);
      evaluate(x, level, true);
    }
  }

  /// @param is_counted  towards the number that was asked for
  /// @return the point's number
  std::size_t evaluate(const std::vector<double>& x, std::size_t level, bool is_counted = false) {
    auto point = point_at(x, level);
    auto& points = result_.plan.points;
    const auto known = std::find_if(points.begin(), points.end(),
                                    [&](const SweepPoint& p) { return p.settings == point.settings; });
    if (known != points.end()) return std::size_t(known - points.begin());
    if (is_counted && n_counted_ >= request_.most_evaluations) throw EvaluationsUsedUp();
    n_counted_ += is_counted ? 1 : 0;
    auto row = given_.evaluate(point, tolerance_of(level));
    if (row.refused.empty() && !has_units_) take_units(row);
    points.push_back(std::move(point));
    result_.rows.push_back(std::move(row));
    result_.levels.push_back(level);
    return points.size() - 1;
  }

  SweepPoint point_at(const std::vector<double>& x, std::size_t level) const {
    SweepPoint point;
    for (std::size_t v = 0; v < x.size(); ++v) {
      const auto& variation = request_.variations[v];
      point.numbers.push_back(number_at(*variation.range, x[v]));
      point.values.push_back(variation.text_of(point.numbers.back()));
      for (const auto& key : variation.keys()) point.settings.push_back(key + "=" + point.values.back());
    }
    if (!(given_.tolerance > 0)) return point;
    point.numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    point.values.push_back(fmt::format("{:.6g} %", 100 * tolerance_of(level)));
    point.settings.push_back("tolerance=" + point.values.back());
    return point;
  }

  /// The first row that is not refused says which figures there are, and in which units.
  void take_units(const SweepRow& row) {
    has_units_ = true;
    require_figure(request_.maximises ? "--maximise" : "--minimise", request_.goal, row);
    for (const auto& bound : request_.bounds) result_.bounds_si.push_back(bound_in_si(bound, row));
    goal_scale_ = std::abs(row.figure(request_.goal));
    if (!(goal_scale_ > 0) || !std::isfinite(goal_scale_)) goal_scale_ = 1;
  }

  std::vector<double> coordinates(std::size_t p) const {
    std::vector<double> x;
    for (std::size_t v = 0; v < request_.variations.size(); ++v)
      x.push_back(coordinate_of(*request_.variations[v].range, result_.plan.points[p].numbers[v]));
    return x;
  }

  bool is_refused(std::size_t p) const {
    return !result_.rows[p].refused.empty() || std::isnan(result_.rows[p].figure(request_.goal));
  }

  /// The goal, scaled, to be least.
  double goal(std::size_t p) const {
    const double value = result_.rows[p].figure(request_.goal) / goal_scale_;
    return request_.maximises ? -value : value;
  }

  CobylaTrial trial_of(std::size_t p) const {
    CobylaTrial trial;
    if (is_refused(p)) {  // worse than all others, and far from every bound
      for (std::size_t q = 0; q < p; ++q)
        if (!is_refused(q)) trial.goal = std::max(trial.goal, goal(q));
      trial.goal += 1;
      trial.shortfalls.assign(request_.bounds.size(), 1);
      return trial;
    }
    trial.goal = goal(p);
    for (std::size_t b = 0; b < request_.bounds.size(); ++b)
      trial.shortfalls.push_back(lacking(p, b) + margin_of_bounds);
    return trial;
  }

  double lacking(std::size_t p, std::size_t bound) const {
    return shortfall(result_.rows[p], request_.bounds[bound], result_.bounds_si[bound]);
  }
  /// What the bound that is kept least lacks; -1 where there is none.
  double lacking(std::size_t p) const {
    double most = -1;
    for (std::size_t b = 0; b < request_.bounds.size(); ++b) most = std::max(most, lacking(p, b));
    return most;
  }

  /// The best of the points that were solved at a tolerance.
  std::size_t best_at(std::size_t level) const {
    std::optional<std::size_t> best;
    const auto is_better = [&](std::size_t a, std::size_t b) {
      const double lacks_a = std::max(0.0, lacking(a)), lacks_b = std::max(0.0, lacking(b));
      return lacks_a != lacks_b ? lacks_a < lacks_b : goal(a) < goal(b);
    };
    for (std::size_t p = 0; p < result_.rows.size(); ++p)
      if (result_.levels[p] == level && !is_refused(p) && (!best || is_better(p, *best))) best = p;
    return best ? *best : best_at(level - 1);
  }

  void require_any_row() const {
    for (std::size_t p = 0; p < result_.rows.size(); ++p)
      if (!is_refused(p)) return;
    throw StageRefused("no point could be computed: " + result_.rows.front().refused);
  }

  /// Whether the error of a bound's figure is larger than the distance to the bound.
  bool needs_sharper_solve(std::size_t p) const {
    const auto& row = result_.rows[p];
    for (std::size_t b = 0; b < request_.bounds.size(); ++b) {
      const double error = stated_error(row, request_.bounds[b].figure), bound_si = result_.bounds_si[b];
      const double distance = std::abs(assured(row, request_.bounds[b]) - bound_si);
      if (distance < error && error > error_that_matters * std::abs(bound_si)) return true;
    }
    return false;
  }

  double tolerance_of(std::size_t level) const { return level == 0 ? given_.tolerance : sharper_; }

  /// A fifth of the tolerance, or half of what the bodies of the bounds are known to where that is less; a
  /// tolerance with two digits.
  double sharper_tolerance(const SweepRow& row) const {
    double sharper = given_.tolerance / 5;
    for (const auto& bound : request_.bounds) {
      const auto governing = bound.figure.substr(0, bound.figure.find('.', 7)) + ".governing";
      const double share = row.figure(governing + ".error") / row.figure(governing);
      if (share > 0) sharper = std::min(sharper, share / 2);
    }
    return std::max(least_tolerance, std::strtod(fmt::format("{:.1e}", sharper).c_str(), nullptr));
  }

  bool has_less_error(std::size_t before, std::size_t after) const {
    for (const auto& bound : request_.bounds)
      if (stated_error(result_.rows[after], bound.figure) <
          lower_error * stated_error(result_.rows[before], bound.figure))
        return true;
    return false;
  }

  /// One point beside the optimum for each variation, towards the middle of its range.
  void evaluate_beside(std::size_t level) {
    for (std::size_t v = 0; v < request_.variations.size(); ++v) {
      auto x = coordinates(result_.best);
      x[v] += x[v] <= 0.5 ? step_beside : -step_beside;
      const auto p = evaluate(x, level);
      if (!is_refused(p)) result_.beside[v] = p;
    }
  }

  const OptimumRequest& request_;
  const OptimumSearch& given_;
  Optimum result_;
  bool has_units_ = false;
  double sharper_ = 0;  ///< tolerance of level 1
  int n_counted_ = 0;
  double goal_scale_ = 1;
};

}  // namespace

std::optional<double> Optimum::sensitivity(const std::string& figure, std::size_t variation) const {
  const auto& other = beside.at(variation);
  if (!other) return std::nullopt;
  const double change = rows[*other].figure(figure) - rows[best].figure(figure);
  const double step = plan.points[*other].numbers[variation] - plan.points[best].numbers[variation];
  const double value = change / step;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Optimum find_optimum(const OptimumRequest& request, const OptimumSearch& search) {
  return PathSearch(request, search).run();
}

}  // namespace pipelines
