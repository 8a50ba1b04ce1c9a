/// The picture of a body's envelope among the results of a run.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/search/loop/duty_run.h"
#include "pipelines/search/loop/scene_run.h"

namespace pipelines {

/// Draws envelope.png beside the envelope of one body, which is written: its governing stress is marked with
/// the verdict, and the weld toes that last least with their lives. On the first rank.
/// @param place  the folder of the body's results
/// @param duty   operating blocks, if the scene has any; else null
/// @return empty; on a machine that cannot draw, the line that says so
std::string draw_envelope(const std::filesystem::path& place, const SceneRun& run, const Judged& analysis,
                          const DutyResult* duty);

}  // namespace pipelines
