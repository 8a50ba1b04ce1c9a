/// What the stage `superpose` knows of a body: its unit responses under the loads of a cycle.
#pragma once

#include <optional>
#include <utility>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/respond/responses/responded.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

struct Superposed : Responded {
  Closure closure;
  NodePlaces places;
  Envelope envelope;

  Superposed() = default;
  explicit Superposed(Responded responded) : Responded(std::move(responded)) {}
};

/// @param known  the envelope of these loads and responses, where it need not be computed again
/// @throws LoadsDoNotClose if the loads do not close to 1e-9 on the mesh; NotFinite
Superposed superpose(Responded responded, int n_threads, StageClock& clock,
                     std::optional<Envelope> known = std::nullopt);

}  // namespace pipelines
