/// The search for an optimum that knows the errors of its figures.
///
/// A bound holds only with the stated error of its figure. Where at the end of a search the distance to a
/// bound is less than that error, the point is solved again at a fifth of the tolerance, or at half of what
/// its body is known to where that is less. The search goes on from there with small steps if the error
/// became less by that, or if the bound is not kept any more.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/study/optimum/optimum_request.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

struct OptimumSearch {
  std::vector<double> start;  ///< by variation, in its unit and range
  double tolerance = 0;       ///< of the first points, a share; 0: none is asked for, nor a sharper one
  /// The row of a point, solved to a tolerance.
  std::function<SweepRow(const SweepPoint& point, double tolerance)> evaluate;
};

struct Optimum {
  SweepPlan plan;  ///< points in the order in which they were computed; the tolerance is a variation of them
  std::vector<SweepRow> rows;       ///< by point
  std::vector<std::size_t> levels;  ///< by point: 0, or 1 of those that were solved sharper
  std::vector<double> bounds_si;    ///< by bound
  std::size_t best = 0;        ///< the optimum; where no point keeps all bounds, the one that lacks least
  bool is_kept = false;        ///< the best point keeps all bounds
  bool has_converged = false;  ///< else the evaluations were used up
  /// By variation: a point beside the optimum, for sensitivities; none: it was refused, or bounds are not
  /// kept.
  std::vector<std::optional<std::size_t>> beside;

  /// Change of a figure by one unit of a variation; nothing where it is not known.
  std::optional<double> sensitivity(const std::string& figure, std::size_t variation) const;
};

/// The first point is the start. Points are rounded to 1e-5 to 1e-4 of a range, so that each has a short
/// text, and no point is evaluated twice.
/// @throws OptionError for figures that rows do not have; StageRefused if all rows are refused; what
/// evaluate() throws
Optimum find_optimum(const OptimumRequest& request, const OptimumSearch& search);

}  // namespace pipelines
