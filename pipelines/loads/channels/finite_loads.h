/// No load that is not finite leaves the load stage or the distribution.
#pragma once

#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

// Each throws NotFinite naming the stage, the first quantity that is not finite, and when.
void require_finite(const kinetics::LoadHistory& loads);  ///< but for quantities that have poles
void require_finite(const BodyLoads& loads);              ///< distribution

}  // namespace pipelines
