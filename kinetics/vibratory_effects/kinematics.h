/// Where the chamber's centre C and the charge's centre O are and how they move, as quantities.
///
/// C.x ... O.ay: position, velocity and acceleration in the fixed frame (x right, y up), positions from C1,
/// the chamber's centre at rest. Everything is arithmetic on the block of instants that the loads need
/// anyway.
#pragma once

#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

/// Convention `consistent`, any motion of the drive.
///   C = s + theta z x c, (1) and the pitch, to the first order of theta
///   O = s + r e(chi), (4); s is that of phi - eta with `charge_lag`; + theta z x c with
///   `charge_follows_pitch`
/// Velocities and accelerations are their derivatives in time, so that the charge's inertia is -m a_O when
/// all of its effects are on.
void write_kinematics(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at,
                      LoadHistory& history);

/// Convention `published`, steady running: C (1) and O (4) with their velocities; accelerations a_C (16),
/// a_OC (20), a_k (24), a_n (25), a_xi (26), a_O (27), and C.ax ... O.ay, the vectors that these are parts
/// of. (15) drops a term, so that O.ax, O.ay are not the derivatives of O.vx, O.vy: they lack -omega_e^2 r
/// e(chi).
void write_published_kinematics(const VibratoryMill& mill, const Instants& at, LoadHistory& history);

}  // namespace kinetics::vibratory
