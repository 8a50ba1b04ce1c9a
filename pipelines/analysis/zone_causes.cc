#include "pipelines/analysis/zone_causes.h"

namespace pipelines {
namespace {

/// Of the peak.
constexpr double least_amplitude = 1e-9;

ZoneCauses causes_at(const Zone& zone, const fem::UnitResponses& responses, const ChannelHistory& loads) {
  const UnitStresses unit_Pa = unit_stresses_at(responses, zone.peak_node);
  ZoneCauses causes;
  causes.peak = shares_of_stress(unit_Pa, loads, zone.instant);
  causes.cycle = largest_cycle((unit_Pa * loads.values.matrix()).array());
  if (causes.cycle.amplitude_Pa > least_amplitude * zone.peak_Pa)
    causes.amplitude = shares_of_change(unit_Pa, loads, causes.cycle.from, causes.cycle.to);
  return causes;
}

}  // namespace

std::vector<ZoneCauses> causes_of(const Zones& zones, const fem::UnitResponses& responses,
                                  const ChannelHistory& loads) {
  std::vector<ZoneCauses> causes;
  for (const auto& zone : zones.zones) causes.push_back(causes_at(zone, responses, loads));
  return causes;
}

}  // namespace pipelines
