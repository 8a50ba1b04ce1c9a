/// Whether ports of a CAD part have a surface, told before it is meshed.
#pragma once

#include <vector>

#include "meshes/imported/import.h"

namespace meshes {

/// Looks in gmsh's current model for a surface of each port. What passes may be refused still once the part
/// is meshed: surfaces are taken by the nodes of a mesh, and here by the curves around them, with room for
/// coarse cells.
/// @param unit_m  length of the model's unit
/// @throws GeometryRefused naming the first port that no surface can belong to
void require_surfaces_of_ports(const std::vector<ImportPort>& ports, double unit_m);

}  // namespace meshes
