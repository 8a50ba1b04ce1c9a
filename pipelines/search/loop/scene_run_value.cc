#include <algorithm>

#include "pipelines/search/loop/scene_run.h"

namespace pipelines {

SceneRun::SceneRun() = default;
SceneRun::SceneRun(const SceneRun&) = default;
SceneRun::SceneRun(SceneRun&&) noexcept = default;
SceneRun& SceneRun::operator=(const SceneRun&) = default;
SceneRun& SceneRun::operator=(SceneRun&&) noexcept = default;
SceneRun::~SceneRun() = default;

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
