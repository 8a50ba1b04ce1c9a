/// The way of a run to its tolerance, as values: every mesh that was tried, and why it ended.
#pragma once

#include <string>
#include <vector>

#include "pipelines/judge/estimates/error_budget.h"

namespace pipelines {

/// One run on the way.
struct SearchStep {
  std::string fineness;  ///< fineness of the mesh, in words
  std::string refined;   ///< what became finer before it: "around", "fillets"; empty: the first mesh
  std::string place;     ///< place that governs
  int instants_per_turn = 0, pressure_harmonics = 0;
  std::size_t n_dofs = 0;
  double value_Pa = 0;      ///< the governing stress
  ErrorBudget errors;       ///< errors of the governing stress
  double principal_Pa = 0;  ///< largest principal stress outside the exclusion distances
  double seconds = 0;       ///< duration of this step
  double gigabytes = 0;     ///< the program's largest memory up to the end of this step
};

struct Search {
  std::string quantity;     ///< the stress that the tolerance refers to
  double tolerance = 0;     ///< relative; 0: as good as the time allows
  double time_limit_s = 0;  ///< limit of the whole run; 0: none
  bool met = true;
  std::string ended;                ///< why no further step was taken
  double next_seconds = 0;          ///< what the next step was predicted to take; 0: none was planned
  std::vector<SearchStep> steps{};  ///< none: the scene's own mesh, once

  bool time_was_up() const { return ended == "the time is up"; }
};

}  // namespace pipelines
