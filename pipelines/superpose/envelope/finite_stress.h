/// No stress that is not finite leaves the solve or the superposition.
#pragma once

#include <string>

#include "fem/base/values/unit_responses.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

// Each throws NotFinite naming the stage, the first quantity that is not finite, and where.
void require_finite(const fem::UnitResponses& responses);                ///< solve and stress recovery
void require_finite(const std::string& body, const Envelope& envelope);  ///< superposition

}  // namespace pipelines
