/// Choosing the springs of the vibratory mill: the total stiffness that loads the frame's bearings least.
///
/// Source: the purpose of Gracheva's model; the paper's own K* (60) has poles and is no choice. Ours instead:
/// the reaction R_E is affine in the stiffness as long as the pitch is held, R_E = R0(t) + k G(t).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics {

/// What is made small: the root of the mean square of |R_E|, or its largest value over the instants.
enum class SpringAim { rms, peak };

/// Where springs are looked for: common scales of all given stiffnesses. With the pitch held the optimum is
/// in closed form, and the scales bound it only where they are asked to.
struct SpringSearch {
  double least_scale = 1e-2;  ///< > 0
  double most_scale = 1e2;    ///< > least_scale
  int n_scan = 800;           ///< log-spaced scales of the scan, >= 3; each local minimum is then refined
  double most_transmitted_N = std::numeric_limits<double>::infinity();  ///< limit of transmitted_N, > 0
  bool bounds_held_pitch = false;  ///< scales and limit bound the optimum with the pitch held too
};

/// A scale at which the pitch's natural frequency meets a frequency of its moment.
struct PitchResonance {
  double scale = 0;
  double stiffness_N_m = 0;    ///< total vertical
  double frequency_rad_s = 0;  ///< |p omega_e + q (omega_e + omega_r)|
  int p = 0, q = 0;
  bool between_given_and_chosen = false;
};

struct SpringChoice {
  double stiffness_N_m = 0;     ///< k*, sum of the vertical stiffnesses
  double scale = 0;             ///< k* over that of the given springs; kx goes along
  double reaction_N = 0;        ///< what was made small, at k*
  double reaction_given_N = 0;  ///< the same with the springs as given
  /// Largest size of the springs' force on the ground over the instants, without its mean (the weights): at
  /// k*, and with the springs as given.
  double transmitted_N = 0, transmitted_given_N = 0;
  std::vector<PitchResonance> resonances;  ///< with pitch on, within the search, by rising scale
  std::vector<std::string> warnings;       ///< bounce near the drive, k* at an end of the search ...
};

/// The optimal common scale of all springs, their preloads kept at those of the given ones.
///   pitch off: RMS by k* = -mean(R0 . G) / mean(G . G), clipped at 0; peak by minimising the convex
///              max |R0 + k G|, of an interval of equally good k the smallest. `published`: G = (0, -ecc sin
///              phi).
///   pitch on:  several local minima between resonances: log-spaced scan, each minimum refined.
/// Spring damping is not scaled. Means and maxima are those of the grid's instants.
/// @param effects  must hold `springs`
/// @throws MachineRefused as compute_loads; without eccentricity (the springs then do not move),
/// without
///         the effect `springs` or vertical stiffness, for a malformed search; if every scale is a resonance
///         or transmits more than the limit
SpringChoice choose_springs(const VibratoryMill& mill, const std::vector<std::string>& effects,
                            const TimeGrid& grid, SpringAim aim, const SpringSearch& search = {});

}  // namespace kinetics
