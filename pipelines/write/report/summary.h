/// summary.json: every headline number of a run under keys that stay, and the short table on the terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/judge/texts/run_report.h"

namespace pipelines {

/// The text of summary.json. Everything but `timing` is the same from run to run.
std::string summary_json(const RunReport& report);

/// What effects = "auto" has switched off, and what that could change at most; nothing for other scenes.
/// @param bodies  solved; none: nothing is known of stresses
void print_effect_choice(std::ostream& out, const Scene& scene, const std::vector<Judged>& bodies);

/// The table for a person: verdict, loads, what governs each body with its largest zones and shortest lives,
/// bearings, warnings, seconds. At most fifteen lines a body.
void print_report(std::ostream& out, const RunReport& report);

/// The same with all that explains how the figures came about: every zone, the search's steps, closure,
/// solver, masses, assumptions, seconds per stage.
void print_full_report(std::ostream& out, const RunReport& report);

}  // namespace pipelines
