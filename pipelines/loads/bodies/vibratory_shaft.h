/// The eccentric shaft of the vibratory mill.
#pragma once

#include <array>

#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// What the shaft's loads depend on beside the load stage.
struct VibratoryShaftLoading {
  double gravity_m_s2 = 9.81;
  bool own_weight = false;   ///< effect `gravity_shaft`
  bool own_inertia = false;  ///< effect `shaft_inertia`
  std::array<double, 2> debalance_shares{0.5, 0.5};
};

/// Loads in the frame that turns with the shaft: F_xi = F . e(phi), F_eta = F_x sin(phi) + F_y cos(phi),
/// torques unchanged (coupling of loads and bodies, section 2).
///
/// Ports: eccentric_seat (-B), debalance_1, debalance_2 (force and torque by shares), main_bearing_1,
/// main_bearing_2 (the resultant reaction split by statics), coupling (torque), and the volume (ax, ay: own
/// weight; spin, az: own inertia).
/// @throws StageRefused if a port is missing or the history lacks a resultant (convention
/// `published`)
BodyLoads distribute_vibratory_shaft(const kinetics::LoadHistory& loads, const LoadedBody& body,
                                     const VibratoryShaftLoading& loading);

const LoadMaker& vibratory_shaft_loads();

}  // namespace pipelines
