/// The operating blocks of a scene on the bodies that a run has solved: one superposition for each block.
#pragma once

#include "pipelines/judge/life/duty_result.h"
#include "pipelines/search/loop/scene_run.h"

namespace pipelines {

/// @param as_read  the scene that was run
/// @param run      whose unit responses have the channels of the blocks (SceneRunOptions::duty)
/// @throws StageRefused naming the block that does not fit
DutyResult run_duty(const Scene& as_read, const SceneRun& run, int n_threads, StageClock& clock);

/// Sentences on blocks that stress a body more than the scene's own running, which all other results are of.
std::vector<std::string> blocks_beyond_the_scene(const DutyResult& duty, const SceneRun& run);

/// Sentences on bodies whose lives over all blocks no S-N curve holds for.
std::vector<std::string> duty_lives_beyond_curves(const DutyResult& duty);

}  // namespace pipelines
