/// All that the search for one body's mesh knows on its way. Internal to the search.
#pragma once

#include <chrono>
#include <optional>
#include <set>

#include "pipelines/base/common/several_ranks.h"
#include "pipelines/search/refinement/local_refinement.h"
#include "pipelines/search/refinement/peak_growth.h"
#include "pipelines/search/refinement/place_history.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {

using Clock = std::chrono::steady_clock;

/// On the first rank of those that share a body: all of them decide alike.
inline double seconds_since(Clock::time_point start) {
  return as_on_first_rank(std::chrono::duration<double>(Clock::now() - start).count());
}

struct SearchState {
  explicit SearchState(const BodyScene& body) : history(mesh_parts(body), trust_in_meshes(body)) {}
  Search search;
  PlaceHistory history;
  PeakGrowth growth;
  std::optional<MeshStep> step;   ///< that led to the present mesh
  LocalRefinement local{};        ///< what the next step would cut
  bool others_are_judged = true;  ///< on the present mesh, places that do not lead, too
  std::set<MeshPart> exhausted;   ///< parts that cannot be finer
  double end_s = 0;               ///< when the time is up, from the start of the run; 0: never
  Clock::time_point step_start = Clock::now();
  double second_model_s = 0;  ///< of the step, which a finer mesh does not take again
};

}  // namespace pipelines
