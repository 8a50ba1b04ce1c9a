/// A question to a mill beside its loads: how large at any angle.
#pragma once

#include <iosfwd>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Extremes over all angles, beside those of the scene's window. Of a vibratory mill: over all pairs of drive
/// and charge angles. Of a planetary mill: the axle's load over the carrier's turn in closed form (its
/// hodograph), and what follows from the machine's parameters, (1)-(13).
/// @throws StageRefused if the scene's machine is no mill; as kinetics does
void print_extremes(std::ostream& out, const Scene& scene, bool json);

}  // namespace pipelines
