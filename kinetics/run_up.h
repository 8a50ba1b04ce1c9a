/// Start-up, run-down and any other given speed of the vibratory mill's drive: loads with their transients.
///
/// The drive's speed is prescribed and linear between the entries of a table, so phi'' is constant in each of
/// its segments and jumps at the entries. The charge circulates in proportion to the drive: omega_r / omega_e
/// is the mill's at all times (its circulation starts and stops with the chamber; an assumption, not the
/// paper's). With the effect `pitch` the chamber's pitch is integrated in time,
///   I theta'' + c_theta theta' + k_theta theta = M(t),
/// by average acceleration (Newmark, beta = 1/4, gamma = 1/2): second order, unconditionally stable, and
/// without damping of its own. Source: ours; Newmark (1959).
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/drive_course.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics {

/// A run-up from one speed to another at constant acceleration, then on at the latter.
/// @param hold_s  may be zero
RunUp ramp(double from_rad_s, double to_rad_s, double duration_s, double hold_s = 0);

/// Loads over the run: resultants and quantities as of compute_loads (convention `consistent`), time_s no
/// longer equidistant where segments differ. An instant at an entry of the table has the acceleration after
/// it. With pitch also, in J since the start: pitch_energy, I theta'^2 / 2 + k_theta theta^2 / 2; pitch_work,
/// of M at the midpoints of the steps; pitch_dissipation; pitch_energy_residual, what these leave: round-off.
/// @throws MachineRefused as compute_loads; for the convention `published`, which knows no unsteady
///         motion; for a malformed table or step, or more than 2 million steps; if the default start is a
///         resonance, or finds a moment at rest that no stiffness resists
LoadHistory compute_run_up(const VibratoryMill& mill, const std::vector<std::string>& effects,
                           const RunUp& run);

/// Refuses what compute_run_up would refuse before it integrates.
/// @throws MachineRefused as compute_run_up does for effects, parameters and the run's table
void check_run_up(const VibratoryMill& mill, const std::vector<std::string>& effects, const RunUp& run);

}  // namespace kinetics
