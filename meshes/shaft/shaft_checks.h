/// Refusals of shafts that cannot be meshed.
#pragma once

#include "meshes/shaft/shaft_geometry.h"

namespace meshes {

/// @throws GeometryRefused with the offending numbers (mm) and what to change
void check_shaft(const Shaft& shaft);
void check_control(const ShaftMeshControl& control);

}  // namespace meshes
