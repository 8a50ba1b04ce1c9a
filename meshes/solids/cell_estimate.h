/// How many tetrahedra a mesh control asks for, told from volumes and areas before anything is meshed.
#pragma once

#include <string>

#include "meshes/solids/solid_control.h"

namespace meshes {

/// Of gmsh's current model, as built or imported by OpenCASCADE: regular tetrahedra in the volumes, and three
/// for each triangle of a surface whose curvature asks for shorter edges. Within a factor of 3 of gmsh's
/// meshes (unit test cell_estimates).
/// @param unit_m  length of the model's unit
double estimated_cells(const SolidControl& control, double unit_m);

/// The field that most of the cells are owed to where there are too many.
std::string control_of_cells(const SolidControl& control);

}  // namespace meshes
