/// Vibratory mill with an eccentric drive: loads on chamber, shaft and bearings.
///
/// Source: N. U. Gracheva, "Development of a mathematical model of vibratory mill taking into account the
/// dynamic loads to the bearing arrangements", equations (1)-(60).
/// Errata and the `consistent` convention: kinetics/README.md.
/// x right, y up; phi and chi CLOCKWISE from +x; e(a) = (cos a, -sin a), n(a) = (-sin a, -cos a).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics {

/// Evaluates the named effects, and only those, over the instants of the grid.
///
/// Resultants under `consistent` (fixed frame; see coupling of loads and bodies):
///   "eccentric"       force -B of the chamber on the shaft, through E' = ecc e(phi)
///   "debalance"       force on the debalances; fx, fy act at KE e(phi); torque: its moment about E
///   "frame_bearings"  reaction R_E of the frame's bearings on the shaft, through E (massless shaft)
///   "drive"           torque -T of the coupling on the shaft (T clockwise positive), fx = fy = 0
///   "housing_bore"    force B of the eccentric on the chamber, through E'
///   "inner_wall"      force F_w of the charge on the wall, through its axis C; torque r e(chi) x F_w
///   "spring_foot_i"   force f_i of spring i = 1, 2, ... on the chamber at its foot
/// The joints ("eccentric", "frame_bearings", "drive", "housing_bore") are always there; the others only if
/// an effect that is on loads them.
///
/// Quantities under `consistent`: chi, theta, theta_dot, theta_ddot (zero with pitch off), C.x, .y, .vx, .vy,
/// .ax, .ay and O.x ... .ay (position from C1, velocity, acceleration of the chamber's and of the charge's
/// centre, fixed frame; the charge's as its effects have it: vibratory_effects/kinematics.h), B_x, B_y, B,
/// X_E, Y_E, R_E, T, drive_power, couple, moment_residual [N m, about E'], closure_force and closure_moment
/// (relative, the worse of the two bodies); with the effects they belong to: neglected_pitch_centripetal,
/// spring_<i>.fx, .fy, spring_force, damping_power, charge_on_wall.fx, .fy, charge_at.x, .y (from E'),
/// charge_power. Under `published`, by the paper's equations: X_E (42), Y_E (43), R_E (44), C.x ... O.ay (1),
/// (4), (16), (27), chi, a_C (16), a_OC (20), a_k (24), a_n (25), a_xi (26), a_O (27), OD (57), DE (58); with
/// the effects they belong to F_d (33), F_e (35), F_r (37), F_k (39), F_ex, F_ey, F_rx, F_ry, F_kx, F_ky
/// (45)-(50), and with `springs` spring_force (31), spring_force_from_moments (59), K_star (60; at its poles
/// the principal value, has_statistics = false); no resultant but "frame_bearings".
///
/// Without `springs`' preload given, it is the static balance of those weights that are in effect, the
/// charge's centre taken at C.
/// @param effects  names in any order; they are summed in the order of vibratory_mill_effects
/// @throws MachineRefused naming parameter, value and remedy: NaN or infinity, a negative mass,
///         one that is missing for an effect, speed not positive, I_E < m1 |l|^2, an unknown effect (with the
///         nearest known one) or one that lacks the effect it builds on, an undamped pitch resonance,
///         k_theta = 0 with a mean moment, sin(eta) above 1, charge_lag without angle or power, `published`
///         with other than two springs
LoadHistory compute_loads(const VibratoryMill& mill, const std::vector<std::string>& effects,
                          const TimeGrid& grid);

/// The smallest whole number q of turns after which the loads repeat, (omega_e + omega_r) / omega_e = p / q;
/// empty if no q up to `most_turns` gives the ratio to 1e-9. One turn if charge_offset_m is zero.
std::optional<int> period_in_turns(const VibratoryMill& mill, int most_turns = 1000);

}  // namespace kinetics
