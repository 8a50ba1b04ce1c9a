/// The results that a command on a run's files needs.
#pragma once

#include <filesystem>

#include "pipelines/commands/scene_options.h"

namespace pipelines {

/// Runs the scene as `millstress run` does, without its table, unless the directory has the results of it as
/// it is.
/// @throws what the run throws; ToleranceNotMet with the results in their places
void bring_up_to_date(const SceneOptions& scene, const std::filesystem::path& directory, int n_threads);

}  // namespace pipelines
