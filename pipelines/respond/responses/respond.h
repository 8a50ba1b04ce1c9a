/// The unit responses of a body: those of an earlier run where they are of the same body and loads, else
/// solved.
#pragma once

#include <string>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/respond/responses/responded.h"

namespace pipelines {

/// The file in a body's folder that keeps the unit responses of a model; a beam keeps none.
std::string kept_responses_name(Method method);

/// By the body's solid model.
/// @throws fem::SolveFailed, fem::DoesNotFit as fem::Model::unit_responses
Responded respond(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, const RunOptions& options,
                  StageClock& clock);

/// Leaves the unit responses in unit_responses.h5 for the next run.
/// @return text_hash of the key that they are kept under
std::string keep_responses(const BodyScene& body, const MeshedBody& meshed, const Responded& responded,
                           const RunOptions& options, StageClock& clock);

/// Leaves the unit responses of harmonics around the axis, at their revolved nodes, in unit_harmonics.h5 for
/// whoever reads stress over the cycle. No run takes them again: their key is their own content. Those of a
/// solid stay beside them, for its next run.
/// @return text_hash of the key that they are kept under
/// @throws FileError naming the file if it cannot be written
std::string keep_harmonics(const Responded& responded, const RunOptions& options, StageClock& clock);

/// So many threads, or as many as the machine has where the number is not positive.
int threads(int wanted);

}  // namespace pipelines
