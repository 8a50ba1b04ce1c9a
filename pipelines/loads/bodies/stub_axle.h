/// One of the two stub axles that carry the planetary mill's drum.
#pragma once

#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// Loads in the carrier's axes (coupling of loads and bodies, section 5).
///
/// Ports: bearing (its share of the load on the axle: what acts at mid-span half, belt and pulley by their
/// plane), volume (ax, ay, spin of the carrier), clamp (minus the resultant: fx, fy, mx, my; torque only from
/// rounding).
/// @param effects  effects of the scene; `axle_gravity`, `axle_transport` are the body's own
/// @throws StageRefused as distribute_drum
BodyLoads distribute_stub_axle(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                               const LoadedBody& body, const StubAxleOptions& options,
                               const std::vector<std::string>& effects);

const LoadMaker& stub_axle_loads();

}  // namespace pipelines
