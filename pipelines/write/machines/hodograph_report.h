/// The load on a planetary mill's axle over the carrier's whole turn, in closed form.
#pragma once

#include <iosfwd>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// What follows from the parameters, (1)-(13); X_A and Y_A as mean + cosine cos(phi) + sine sin(phi); largest
/// and least R_A with their angles, beside those of the scene's window. Where the load is no ellipse (T1 - T2
/// changes its sign, and the strands swap) only the window is told, with the reason.
/// @param json  as JSON instead of tables
/// @throws StageRefused as compute_loads and kinetics::hodograph; the scene's machine is a planetary mill
void print_hodograph(std::ostream& out, const Scene& scene, bool json);

}  // namespace pipelines
