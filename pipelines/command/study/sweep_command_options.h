/// The options of `millstress sweep`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/scene_options.h"

namespace pipelines {

struct SweepCommandOptions : SceneOptions {
  std::vector<std::string> vary;  ///< none: the scene's
  std::string design;             ///< empty: the scene's
  int n_points = 0;               ///< 0: the scene's
  long seed = -1;                 ///< negative: the scene's
  std::filesystem::path output;
  std::string tolerance, time_limit, method;  ///< empty: the scene's
  std::vector<std::string> figures;           ///< to print and draw; none: chosen
  int n_threads = all_cores;
  bool loads_only = false, zones = false, fresh = false, json = false;
};

}  // namespace pipelines
