/// The drum of the planetary mill, with hollow trunnions.
#pragma once

#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// What the drum's loads depend on beside the load stage.
struct DrumLoading {
  std::vector<std::string> effects;    ///< effects of the scene; `drum_spin` is the body's own
  std::vector<AttachedMass> attached;  ///< the pulley, differences to the mesh
};

/// Loads in axes that turn with the drum, alpha = psi (coupling of loads and bodies, section 4).
///
/// Ports: inner_wall (force through A and the torque l_AC u x F), trunnion_1, trunnion_2 (the load stage's
/// reaction split by statics), pulley_seat (belt: force and torque), volume (drum_transport, drum_gravity;
/// spin: drum_spin), attached masses.
/// @throws StageRefused if a port is missing, or the history is not in equilibrium (conventions
/// `as_published`, `as_plotted` beyond 1e-12)
BodyLoads distribute_drum(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                          const LoadedBody& body, const DrumLoading& loading);

const LoadMaker& drum_loads();

}  // namespace pipelines
