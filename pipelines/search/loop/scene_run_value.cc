#include <algorithm>

#include "pipelines/search/loop/scene_run.h"

namespace pipelines {

bool SceneRun::met() const {
  return std::all_of(analyses.begin(), analyses.end(), [](const auto& a) { return a.search.met; });
}

bool SceneRun::time_was_up() const {
  return std::any_of(analyses.begin(), analyses.end(), [](const auto& a) { return a.search.time_was_up(); });
}

bool SceneRun::tells_of_damage() const {
  return std::any_of(analyses.begin(), analyses.end(), [](const auto& a) { return !a.warnings.empty(); });
}

}  // namespace pipelines
