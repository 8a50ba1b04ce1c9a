/// The criteria of a verdict, one function each. Internal to the room.
#pragma once

#include "pipelines/judge/verdict/verdict.h"

namespace pipelines {

/// Largest stress against the yield strength, of running, of all operating blocks, and of a start.
Finding judge_yield(const RunReport& report, const Judged& analysis);

/// Fatigue of the surface; none where the scene has switched it off.
std::optional<Finding> judge_surface(const RunReport& report, const Judged& analysis);

/// Fatigue of weld toes; none of bodies without, or where the scene has switched it off.
std::optional<Finding> judge_welds(const RunReport& report, const Judged& analysis);

/// What resonance adds to the body's stress, or how near a shaft is to a critical speed: the worse one.
Finding judge_resonance(const RunReport& report, const Judged& analysis);

/// One finding for each bearing of the scene; one that says what is missing where bodies have bearings of
/// which the scene gives no ratings.
std::vector<Finding> judge_bearings(const RunReport& report);

/// Excitations of a drive train beside its natural frequencies; none of other machines.
std::optional<Finding> judge_torsion(const RunReport& report);

/// What a margin says with its error: it holds, does not, or is left open by the error.
/// @param least  none: the error is not known
Judgement weigh(double margin, const std::optional<double>& least);

/// The worse of two: by judgement, then by what is left of the margin.
bool is_worse(const Finding& a, const Finding& b);

/// What settles a figure whose error leaves it open.
/// @param error_share  whole error of the stress that the figure follows from; infinite: not known
std::string remedy_of_open(const Judged& analysis, double error_share);

}  // namespace pipelines
