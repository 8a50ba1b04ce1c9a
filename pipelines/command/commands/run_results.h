/// The results that a command on a run's files needs.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/command/options/scene_options.h"

namespace pipelines {

/// What the command line says of the run itself.
struct WantedRun : SceneOptions {
  std::string tolerance, time_limit, method;  ///< empty: the scene's
  int n_threads = all_cores;
};

/// --tolerance, --time-limit, --method and --threads.
void add_run_options(CLI::App& command, WantedRun& options, ChosenCommand& chosen);

/// Runs the scene as `millstress run` does, without its table, unless the directory has the results of it as
/// it is, and unit responses are there.
/// @throws what the run throws; ToleranceNotMet with the results in their places
void bring_up_to_date(const WantedRun& wanted, const std::filesystem::path& directory);

}  // namespace pipelines
