/// Refusals of bores that cannot be meshed.
#pragma once

#include "meshes/shaft_layout/shaft_geometry.h"

namespace meshes {

/// Names, sizes and the chain of segments have been checked before.
/// @throws GeometryRefused with the offending numbers (mm) and what to change
void check_bores(const Shaft& shaft);

}  // namespace meshes
