/// Which springs load a vibratory mill's bearings least, within what limits.
#pragma once

#include <iosfwd>
#include <optional>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// What the springs may be. Nothing is asked for by default; then the neighbouring resonances are the bounds.
struct SpringLimits {
  std::optional<double> least_N_m, most_N_m;  ///< limits of the sum of the vertical stiffnesses
  std::optional<double> most_transmitted_N;   ///< largest force on the ground, without the weights
  /// Whether springs are looked for beyond the resonances of the pitch next to the given ones, too, within
  /// 0.01 to 100 times these.
  bool across_resonances = false;
};

/// How far the excitation stays from the pitch's natural frequency with the springs that are proposed.
inline constexpr double resonance_distance = 0.2;

/// The stiffness of the springs that loads the frame's bearings least, by RMS and by peak: goal, limits and
/// what sets them, the springs within, the resonances of the pitch, and what lies beyond; with the warnings
/// of the scene's loads. All springs are scaled alike.
/// @param json  as JSON instead of a table
/// @throws StageRefused if the scene's machine is no vibratory mill; OptionError for limits that leave
/// nothing; as kinetics::choose_springs
void print_spring_choice(std::ostream& out, const Scene& scene, const SpringLimits& limits, bool json);

}  // namespace pipelines
