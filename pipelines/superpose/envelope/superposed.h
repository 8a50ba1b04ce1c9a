/// What the stage `superpose` knows of a body: its unit responses under the loads of a cycle.
#pragma once

#include <optional>

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

  // In the .cc file: else every file that copies one compiles the copies of all members anew.
  Superposed();
  explicit Superposed(Responded responded);
  Superposed(const Superposed&);
  Superposed(Superposed&&) noexcept;
  Superposed& operator=(const Superposed&);
  Superposed& operator=(Superposed&&) noexcept;
  ~Superposed();
};

/// @param known  the envelope of these loads and responses, where it need not be computed again
/// @throws LoadsDoNotClose if the loads do not close to 1e-9 on the mesh; NotFinite
Superposed superpose(Responded responded, int n_threads, StageClock& clock,
                     std::optional<Envelope> known = std::nullopt);

}  // namespace pipelines
