#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/base/common/failure.h"
#include "pipelines/study/accuracy/accuracy.h"

namespace pipelines {
namespace {

/// Distances below the reference's own error are not told from each other.
void mark_frontier(std::vector<AccuracyRow>& rows, double told_from_Pa) {
  double least = std::numeric_limits<double>::infinity();
  for (auto& row : rows)
    if (const double told_Pa = std::max(row.true_error_Pa, told_from_Pa);
        !row.is_reference && told_Pa < least) {
      row.on_frontier = true;
      least = told_Pa;
    }
}

void choose(AccuracyStudy& study) {
  const auto& rows = study.rows;
  const auto first_within = [&](double error_Pa) {
    return std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
      return !row.is_contradicted && row.errors.total_Pa() <= error_Pa;
    });
  };
  const auto chosen = first_within(study.tolerance * study.reference_Pa);
  if (chosen == rows.end()) {
    study.next_factor_of_two =
        fmt::format("no run is known to be within {:g} %; give more time", 100 * study.tolerance);
    return;
  }
  study.chosen = std::size_t(chosen - rows.begin());
  const auto next = first_within(0.5 * chosen->errors.total_Pa());
  study.next_factor_of_two =
      next == rows.end()
          ? "the next factor of two in accuracy costs more than this study's time"
          : fmt::format("the next factor of two in accuracy costs {:.2g} seconds ({:.2g} instead of {:.2g})",
                        next->seconds - chosen->seconds, next->seconds, chosen->seconds);
}

}  // namespace

double effectivity(const AccuracyRow& row) {
  return row.true_error_Pa > 0 ? row.errors.total_Pa() / row.true_error_Pa
                               : std::numeric_limits<double>::infinity();
}

void compare_runs(AccuracyStudy& study, double known_Pa) {
  auto& rows = study.rows;
  if (rows.empty()) throw ToleranceNotMet(study.body + ": no model could be run in this time");
  if (known_Pa > 0) {
    study.reference_Pa = known_Pa;
    study.reference = "known value";
  } else {
    auto best = std::min_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
      return a.errors.total_Pa() < b.errors.total_Pa();
    });
    best->is_reference = true;
    study.reference_Pa = best->value_Pa;
    study.reference_error_Pa = best->errors.total_Pa();
    study.reference = fmt::format("overkill run: {}, {} unknowns", best->model, best->n_dofs);
  }
  for (auto& row : rows) {
    row.true_error_Pa = std::abs(row.value_Pa - study.reference_Pa);
    row.is_contradicted = row.true_error_Pa > row.errors.total_Pa() + study.reference_error_Pa;
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  mark_frontier(rows, study.reference_error_Pa);
  choose(study);
}

}  // namespace pipelines
