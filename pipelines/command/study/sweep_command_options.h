/// The options of `millstress sweep`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/command/commands/run_results.h"

namespace pipelines {

struct SweepCommandOptions : WantedRun {
  std::vector<std::string> vary;  ///< none: the scene's
  std::string design;             ///< empty: the scene's
  int n_points = 0;               ///< 0: the scene's
  long seed = -1;                 ///< negative: the scene's
  std::filesystem::path output;
  std::vector<std::string> figures;  ///< to print and draw; none: chosen
  bool loads_only = false, zones = false, fresh = false, json = false;
};

}  // namespace pipelines
