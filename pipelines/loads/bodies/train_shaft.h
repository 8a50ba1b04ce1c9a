/// A shaft of a drive train that carries one of its inertias.
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// Loads in the frame that turns with the shaft, counter-clockwise; its angle is the uniform running plus the
/// vibration (coupling of loads and bodies, section 6). Torques at their ports, inertia as -rho phi'' z x p
/// (effect `shaft_inertia`), viscous drag of the inertia at its bearings; bending only by the forces that the
/// scene gives.
/// @param effects   effects of the scene
/// @param attached  the differences to the mesh
BodyLoads distribute_train_shaft(const kinetics::LoadHistory& loads, double mean_speed_rad_s,
                                 const LoadedBody& body, const TrainShaftOptions& options,
                                 const std::vector<std::string>& effects,
                                 const std::vector<AttachedMass>& attached);

const LoadMaker& train_shaft_loads();

}  // namespace pipelines
