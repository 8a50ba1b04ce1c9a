/// What fatigue takes as given: which size the strengths are for, and rules, factors and defaults, in words.
#pragma once

#include <string>
#include <vector>

#include "pipelines/judge/life/body_fatigue.h"

namespace pipelines {

/// One sentence that stands before all safeties and lives of the body: the tensile strength and the size that
/// it is for, surface and survival; and, where the scene gives no size_factor, what FKM's would make of the
/// place that is used most.
/// @param of_run    with the defaults that it took
/// @param analysis  with fatigue
std::string strength_text(const Scene& of_run, const Judged& analysis);

/// Sentences: rules, factors and defaults.
/// @param analysis  whose scene asks for fatigue
std::vector<std::string> fatigue_assumptions(const Judged& analysis);

}  // namespace pipelines
