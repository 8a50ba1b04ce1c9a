/// Equilibrium of the vibratory mill's two bodies, effect by effect (convention `consistent`).
///
/// (a) the chamber with exciter housing and charge, pivot E' = E + s; (b) the shaft with debalances, axis E.
///   B   = -(sum of all forces on the chamber)           force of the eccentric ON the chamber, at E'
///   R_E = B - (sum of forces on the shaft)              reaction of the frame's bearings ON the shaft
///   T   = -s x B + KE e(phi) x (forces on the shaft)    drive torque on the shaft, clockwise positive
/// All three are linear in the effects' forces, so every contribution keeps its effect.
/// Source: ours; replaces (40)-(44).
#pragma once

#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

/// Load history under the convention `consistent`. `effects` is evaluated once per block of instants; if it
/// contains `pitch`, once more on the (phi, chi) torus.
LoadHistory balance(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const TimeGrid& grid);

/// The same over any motion, pitch included: fills resultants, quantities and warnings of a history that has
/// its instants. Each effect is evaluated once per block of instants.
void balance_over(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& motion,
                  LoadHistory& history);

/// A history with the instants of a motion and nothing else.
LoadHistory empty_history(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                          const Eigen::ArrayXd& time_s, const Instants& motion);

/// Times of the grid's instants in steady running [s].
Eigen::ArrayXd times_s(const VibratoryMill& mill, const Instants& steady);

}  // namespace kinetics::vibratory
