#include "pipelines/judge/figures/zone_causes.h"

#include "pipelines/judge/estimates/time_sampling.h"

namespace pipelines {
namespace {

/// Share of the peak below which an amplitude is rounding.
constexpr double least_amplitude = 1e-9;

/// @param course  the loads, or at denser instants
ZoneCauses causes_at(const Zone& zone, const fem::UnitResponses& responses, const ChannelHistory& loads,
                     const ChannelHistory& course) {
  const UnitStresses unit_Pa = unit_stresses_at(responses, zone.peak_node);
  const double per_instant = double(course.values.cols()) / double(loads.values.cols());
  ZoneCauses causes;
  causes.peak = shares_of_stress(unit_Pa, loads, zone.instant);
  causes.cycle = largest_cycle((unit_Pa * course.values.matrix()).array());
  causes.from = double(causes.cycle.from) / per_instant;
  causes.to = double(causes.cycle.to) / per_instant;
  if (causes.cycle.amplitude_Pa > least_amplitude * zone.peak_Pa)
    causes.amplitude = shares_of_change(unit_Pa, course, causes.cycle.from, causes.cycle.to);
  return causes;
}

}  // namespace

std::vector<ZoneCauses> causes_of(const Zones& zones, const fem::UnitResponses& responses,
                                  const ChannelHistory& loads) {
  const auto denser = denser_course(loads);
  std::vector<ZoneCauses> causes;
  for (const auto& zone : zones.zones)
    causes.push_back(causes_at(zone, responses, loads, denser ? *denser : loads));
  return causes;
}

}  // namespace pipelines
