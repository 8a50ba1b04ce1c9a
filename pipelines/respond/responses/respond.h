/// The unit responses of a body: those of an earlier run where they are of the same body and loads, else
/// solved.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/respond/responses/responded.h"

namespace pipelines {

/// By the body's solid model. Displacements have 24 significant bits, as they have in the user's cache.
/// @throws fem::SolveFailed, fem::DoesNotFit as fem::Model::unit_responses
Responded respond(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, const RunOptions& options,
                  StageClock& clock);

/// Key of the unit responses of a solid model: all that they depend on.
std::string key_of_responses(const BodyScene& body, const MeshedBody& meshed, const BodyLoads& loads,
                             const RunOptions& options);

/// Key of the unit responses of harmonics around the axis, at their revolved nodes: their own content.
/// Whoever reads stress over the cycle takes them, and no run does.
std::string key_of_harmonics(const fem::UnitResponses& responses);

/// What a run has in the user's cache.
struct KeptResponses {
  std::map<std::string, std::string> keys;  ///< by body; cached files have the names of their hashes
  std::vector<std::string> faults;          ///< sentences for the user: what is not there, and why

  /// Leaves unit responses in the cache, unless they came from there. Called on all ranks that share the
  /// body.
  void keep(const Responded& responded, const std::string& key, StageClock& clock);
};

/// So many threads, or as many as the machine has where the number is not positive.
int threads(int wanted);

}  // namespace pipelines
