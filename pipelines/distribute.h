/// Distribution: turns the load stage's resultants into the channels of a body, in the body's frame.
///
/// The planar papers give resultants per cross-section; along the axis they are split by the static
/// equilibrium of the body. The body's own weight and inertia come from its mesh. Everything is done effect
/// by effect, so each channel knows which effect brought how much.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fem/body.h"
#include "fem/unit_load.h"
#include "kinetics/load_history.h"
#include "meshes/body_mesh.h"
#include "pipelines/channels.h"

namespace pipelines {

/// How the vibratory mill's shaft takes its loads.
struct ShaftDistribution {
  double gravity_m_s2 = 9.81;
  bool own_weight = false;   ///< effect `gravity_shaft`
  bool own_inertia = false;  ///< effect `shaft_inertia`
  std::array<double, 2> debalance_shares{0.5, 0.5};
  int pressure_harmonics = 4;  ///< highest harmonic on eccentric and bearing seats; even
};

/// A body's loads: channels over time and, in the same order, their unit loads.
struct BodyLoads {
  ChannelHistory history;
  std::vector<fem::UnitLoad> unit_loads;
  Eigen::Array2Xd
      frame_bearing_force_N;       ///< fixed frame: what the bearings carry, own mass of the body included
  Eigen::ArrayXd drive_torque_Nm;  ///< clockwise positive, own mass of the body included
};

/// The eccentric shaft of the vibratory mill, in the frame that turns with it: F_xi = F . e(phi),
/// F_eta = F_x sin(phi) + F_y cos(phi), torques unchanged.
///
/// Ports: eccentric_seat (-B, pressure), debalance_1, debalance_2 (force and torque by shares),
/// main_bearing_1, main_bearing_2 (pressure; the resultant reaction split by statics), coupling (torque), and
/// the volume (ax, ay: own weight; spin, az: own inertia). A channel that no effect feeds does not exist.
/// @param masses  of the mesh, about the origin on the shaft's axis
/// @throws std::invalid_argument if a port is missing or the history lacks a resultant (convention
/// `published`)
BodyLoads distribute_shaft(const kinetics::LoadHistory& loads, const std::vector<meshes::Port>& ports,
                           const fem::MassProperties& masses, const ShaftDistribution& options);

/// How far a body is from equilibrium, and how exactly the mesh carries what the channels say.
struct Closure {
  std::array<double, 3> force{};  ///< max over the instants of |sum F_c| / max over the instants of sum |F_c|
  std::array<double, 3> moment{};  ///< the same for moments about the origin
  std::array<double, 3> force_scale_N{}, moment_scale_Nm{};
  double channel_resultant =
      0;  ///< max over channels and components of |mesh - wanted| / scale of the channel

  double worst_force() const;
  double worst_moment() const;
};

/// The resultant (force, moment about the origin) that one unit of a channel must have, from ports and masses
/// alone.
std::array<double, 6> wanted_resultant(const fem::UnitLoad& load, const fem::MassProperties& masses);

/// Closure with the resultants of the load vectors as the mesh has them.
/// A component of the moment is scaled by the sum of |r x F| parts and couples of all channels.
/// @param mesh_resultants  K rows: fx, fy, fz, mx, my, mz about the origin for one unit of each channel
Closure check_closure(const BodyLoads& loads, const std::vector<std::array<double, 6>>& mesh_resultants,
                      const fem::MassProperties& masses);

}  // namespace pipelines
