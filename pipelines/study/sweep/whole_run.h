/// A point by a run of its own: all that `run` finds, with every error that it states, at the cost of a run.
#pragma once

#include <string>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_options.h"

namespace pipelines {

/// Whether a figure is one of fatigue, weld toes, operating blocks or margins of the verdict, which points on
/// shared unit responses do not have.
bool is_of_fatigue(const std::string& figure);

/// The figures of a sweep's row, and beside them
///   bodies.<name>.governing.error.total            all errors together
///   bodies.<name>.governing.safety.error           what they may take of the safety
///   bodies.<name>.peak_von_mises.error, .hot_spot.error
/// and where SweepOptions::fatigue asks for it
///   bodies.<name>.margin.<criterion>, with .error  factor on all loads at which the limit is met
///   bodies.<name>.fatigue.utilisation, .safety, .life; .welds.life; .duty.life, each with .error
///                                                  of the place or toe that is used most; infinite: endures
///   bearings.<name>.duty.life                      over the operating blocks
/// and the text bodies.<name>.verdict. Needs an fem::Environment.
/// @param scene  of the point
/// @throws as run_scene
SweepRow whole_run(const Scene& scene, const SweepOptions& options, StageClock& clock);

}  // namespace pipelines
