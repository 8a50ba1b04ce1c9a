/// What the zones of a body come from: which effect and which channel brings how much of their peak and of
/// the amplitude there.
#pragma once

#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/superpose/envelope/stress_cycle.h"
#include "pipelines/superpose/envelope/stress_shares.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

struct ZoneCauses {
  StressShares peak;        ///< shares in the stress at the zone's peak, at its instant
  StressCycle cycle{};      ///< largest cycle there
  double from = 0, to = 0;  ///< its instants: i + share of the step to the next
  StressShares amplitude;   ///< shares in the change over it; empty where the stress does not vary
};

/// Causes of all zones, in their order. Amplitudes below 1e-9 of the peak are rounding: what stands still in
/// the body's frame leaves some, and its shares would be noise.
std::vector<ZoneCauses> causes_of(const Zones& zones, const fem::UnitResponses& responses,
                                  const ChannelHistory& loads);

}  // namespace pipelines
