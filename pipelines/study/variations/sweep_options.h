/// What a sweep is asked for, and what it will take.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/scene/values/requested_accuracy.h"

namespace pipelines {

struct SweepOptions {
  std::filesystem::path scene;
  TomlNode tree;                      ///< tree of the scene
  std::vector<std::string> settings;  ///< settings of all points: --set
  int n_threads = 0;                  ///< 0: all cores
  bool loads_only = false;
  bool fresh = false;
  bool zones = false;            ///< zones of every point, too
  bool whole_runs = false;       ///< every point is run by itself (whole_run.h)
  bool fatigue = false;          ///< in whole runs: fatigue, operating blocks and the verdict
  RequestedAccuracy accuracy{};  ///< accuracy of every mesh that is searched
};

/// What a sweep will take, before it takes it.
struct SweepForecast {
  std::size_t n_points = 0;  ///< points that can be read
  struct Body {
    std::string name;
    std::size_t n_meshes = 0;  ///< meshes of different shape
    /// Solutions of different material or springs, those on new meshes included.
    std::size_t n_solutions = 0;
  };
  std::vector<Body> bodies;  ///< none: the load stage alone
};

}  // namespace pipelines
