/// The bodies of a scene from mesh to zones: once, as the scene has them, or refined until a tolerance is
/// met.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/scene/values/requested_accuracy.h"

namespace pipelines {

struct SceneRunOptions {
  int n_threads = 0;   ///< 0: all cores
  bool fresh = false;  ///< reuse nothing of an earlier run
  bool cache = true;   ///< unit responses of solids are taken from the user's cache, and kept there
  RequestedAccuracy accuracy{};
  bool duty = false;    ///< unit responses also for the channels of operating blocks, whose bodies are the
                        ///< scene's (require_blocks)
  bool fatigue = true;  ///< judged, where the scene asks for it
  bool second_model = true;           ///< harmonics around the axis beside the solid, where they apply
  std::optional<std::size_t> only{};  ///< this body alone is meshed and solved...
  std::vector<MeshedBody> others{};   ///< ...beside these meshes, in the order of Scene::bodies
};

struct SceneRun {
  Loaded loaded;                 ///< by the meshes, instants and harmonics that were chosen
  std::vector<Judged> analyses;  ///< in the order of Scene::bodies, or of the only body
  KeptResponses kept;            ///< unit responses of solids in the user's cache

  /// False if a tolerance was asked for and is not reached.
  bool met() const;

  /// Whether the time ended a search: another run may come further.
  bool time_was_up() const;
  /// Whether the results tell of a damaged file of an earlier run, which has been mended since.
  bool tells_of_damage() const;
};

/// Each body by the cheapest model that keeps the tolerance (search.h); then their zones, their fatigue and
/// their start, on stresses that agree about the loads.
/// With effects = "auto" those are dropped that matter little (effect_choice.h). Should their bound after the
/// solve (effect_bounds.h) exceed the limit all the same, one comes back and the bodies are run again.
/// Leaves unit responses of solids in the user's cache. Needs an fem::Environment.
/// @throws as load_bodies and respond, before any earlier result is touched where the scene is wrong
SceneRun run_scene(const Scene& scene, const SceneRunOptions& options, StageClock& clock);

}  // namespace pipelines
