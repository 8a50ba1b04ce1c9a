/// Two questions to a vibratory mill beside its loads: which springs, and how large at any time.
#pragma once

#include <iosfwd>

#include "pipelines/scene/scene.h"

namespace pipelines {

/// The stiffness of the springs that loads the frame's bearings least, by RMS and by peak, and the resonances
/// on the way.
/// @param json  as JSON instead of a table
/// @throws StageRefused if the scene's machine is no vibratory mill, or as kinetics::choose_springs
void print_spring_choice(std::ostream& out, const Scene& scene, bool json);

/// Extremes over all pairs of drive and charge angles, beside those of the scene's window.
/// @throws StageRefused if the scene's machine is no vibratory mill
void print_torus_extremes(std::ostream& out, const Scene& scene, bool json);

}  // namespace pipelines
