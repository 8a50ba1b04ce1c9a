/// Distribution: turns the load stage's resultants into the channels of a body, in the body's frame; one
/// function per kind of body (coupling of loads and bodies, sections 2 to 6).
///
/// The planar papers give resultants per cross-section; along the axis they are split by the static
/// equilibrium of the body. The body's own weight and inertia come from its mesh. Everything is done effect
/// by effect, so each channel knows which effect brought how much. A channel that no effect feeds does not
/// exist.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/load_history.h"
#include "kinetics/load_table.h"
#include "kinetics/planetary_mill.h"
#include "kinetics/vibratory_mill.h"
#include "pipelines/loads/load_collector.h"

namespace pipelines {

/// How the vibratory mill's shaft takes its loads.
struct VibratoryShaftOptions {
  double gravity_m_s2 = 9.81;
  bool own_weight = false;   ///< effect `gravity_shaft`
  bool own_inertia = false;  ///< effect `shaft_inertia`
  std::array<double, 2> debalance_shares{0.5, 0.5};
};

/// The eccentric shaft of the vibratory mill, in the frame that turns with it: F_xi = F . e(phi),
/// F_eta = F_x sin(phi) + F_y cos(phi), torques unchanged.
///
/// Ports: eccentric_seat (-B), debalance_1, debalance_2 (force and torque by shares), main_bearing_1,
/// main_bearing_2 (the resultant reaction split by statics), coupling (torque), and the volume (ax, ay: own
/// weight; spin, az: own inertia).
/// @throws StageRefused if a port is missing or the history lacks a resultant (convention
/// `published`)
BodyLoads distribute_vibratory_shaft(const kinetics::LoadHistory& loads, const LoadedBody& body,
                                     const VibratoryShaftOptions& options);

/// How the vibratory mill's chamber takes its loads.
struct ChamberOptions {
  std::vector<std::string> effects;     ///< of the scene
  std::vector<AttachedMass> structure;  ///< move with the chamber: covers, differences to the mesh
  std::vector<AttachedMass> exciter;    ///< move with the exciter's housing
  PitchGuide guide = PitchGuide::body;
};

/// The chamber, in axes that translate with it; positions from E'.
///
/// Ports: housing_bore (+B; mx, my for what is not symmetric in z), spring_foot_1.. (f_i), inner_wall (F_w
/// through the axis C and the friction torque r e(chi) x F_w), volume.structure and volume.exciter (gravity,
/// -s'', -theta'' z x p), attached masses at their ports.
/// @param body  region "structure", and "exciter" unless that is an attached mass
/// @throws StageRefused if a port is missing or the history lacks a resultant; std::out_of_range if
/// a region is
BodyLoads distribute_chamber(const kinetics::LoadHistory& loads, const kinetics::VibratoryMill& mill,
                             const LoadedBody& body, const ChamberOptions& options);

/// How the planetary mill's drum takes its loads.
struct DrumOptions {
  std::vector<std::string> effects;    ///< of the scene; `drum_spin` is the body's own
  std::vector<AttachedMass> attached;  ///< the pulley, differences to the mesh
};

/// The drum with its hollow trunnions, in axes that turn with it (alpha = psi).
///
/// Ports: inner_wall (force through A and the torque l_AC u x F), trunnion_1, trunnion_2 (the load stage's
/// reaction split by statics), pulley_seat (belt: force and torque), volume (drum_transport, drum_gravity;
/// spin: drum_spin), attached masses.
/// @throws StageRefused if a port is missing, or the history is not in equilibrium (conventions
/// `as_published`, `as_plotted` beyond 1e-12)
BodyLoads distribute_drum(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                          const LoadedBody& body, const DrumOptions& options);

/// The stub axle, in the carrier's axes.
///
/// Ports: bearing (its share of the load on the axle: what acts at mid-span half, belt and pulley by their
/// plane), volume (ax, ay, spin of the carrier), clamp (minus the resultant: fx, fy, mx, my; torque only from
/// rounding).
BodyLoads distribute_stub_axle(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                               const LoadedBody& body, const StubAxleOptions& options);

/// A shaft of a drive train, in the frame that turns with it, counter-clockwise; its angle is the uniform
/// running plus the vibration. Torques at their ports, inertia as -rho phi'' z x p (effect `shaft_inertia`),
/// viscous drag of the inertia at its bearings; bending only by the optional forces.
BodyLoads distribute_train_shaft(const kinetics::LoadHistory& loads, double mean_speed_rad_s,
                                 const LoadedBody& body, const TrainShaftOptions& options);

/// Every load of the table goes to the port of its name, "volume" being the body itself (ax, ay, az, spin).
/// What does not close is balanced by the supports that the scene names, effect by effect.
/// @throws StageRefused if a port is missing, or a component does not belong to it
BodyLoads distribute_table(const kinetics::LoadTable& table, const std::vector<std::string>& effects,
                           const kinetics::TimeGrid& grid, const LoadedBody& body,
                           const TableBodyOptions& options);

}  // namespace pipelines
