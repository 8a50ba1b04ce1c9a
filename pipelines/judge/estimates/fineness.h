/// How fine a body's mesh is: the scene's own mesh made finer or coarser evenly, or where stress asks for it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

/// Seconds of a run grow like this power of the number of unknowns, with the direct solver.
inline constexpr double growth_of_seconds = 1.5;

/// The body with cells `factor` times smaller in every direction (2: half as long), as far as its mesher's
/// whole numbers allow: even counts on fillets, multiples of 4 around, whole cells through a wall.
BodyScene with_fineness(const BodyScene& body, double factor);

/// Whether with_fineness has an effect: a finished .msh is taken as it is.
bool can_be_refined(const BodyScene& body);

/// The body's fillets, by the names of their features ("fillet left/right"), in the order of
/// meshes::Shaft::fillets_m; an empty name where no fillet is. Empty for bodies that are no parametric
/// shafts.
std::vector<std::string> fillets_of(const BodyScene& body);

/// One line for a report: "fillets 2 8 2 cells per quarter, 16 sectors".
std::string fineness_text(const BodyScene& body);

}  // namespace pipelines
