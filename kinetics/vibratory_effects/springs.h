/// The chamber's spring supports as a set: their static preload, and what they offer against pitch.
#pragma once

#include <string>
#include <vector>

#include "kinetics/vibratory_effects/mill.h"

namespace kinetics::vibratory {

/// The springs with every preload set: as given, or the static balance of those weights that are in effect.
///
/// The chamber at rest, its charge's centre taken at C, hangs on the springs' vertical stiffness:
///   f_i = ky_i (d + a x_i), with d and a from sum f_i = W, sum x_i f_i = sum x_j W_j.
/// For two springs this is plain statics and does not depend on the stiffnesses.
/// @throws MachineRefused if some springs have a preload and others not, or if the springs cannot
///         carry the weights (no vertical stiffness; all feet on one vertical beside the weights' centre)
std::vector<Spring> with_preloads(const VibratoryMill& mill, const std::vector<std::string>& effects);

/// k_theta = sum(kx p_y^2 + ky p_x^2) [N m/rad]: moment about E' against a small pitch.
double pitch_stiffness_Nm(const std::vector<Spring>& springs);
/// c_theta alike [N m s/rad].
double pitch_damping_Nm_s(const std::vector<Spring>& springs);

}  // namespace kinetics::vibratory
