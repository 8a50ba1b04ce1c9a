/// An optimum for people and for machines.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/study/optimum/optimum_search.h"

namespace pipelines {

/// Keys with their values, what limits them, figures at the start and at the optimum with their errors,
/// sensitivities.
void print_optimum(std::ostream& out, const OptimumRequest& request, const Optimum& optimum);

/// algorithm, is_kept, has_converged, evaluations, keys, figures, bounds, sensitivities; in SI but for keys,
/// which have the unit of their range.
std::string optimum_json(const OptimumRequest& request, const Optimum& optimum);

/// Which bound no point keeps, and what can be kept nearest to it.
std::string why_not_kept(const OptimumRequest& request, const Optimum& optimum);

/// A figure with its stated error, "1.503 kg", "3.61 +- 0.08"; an infinite life "endures".
std::string figure_text(const SweepRow& row, const std::string& figure);

}  // namespace pipelines
