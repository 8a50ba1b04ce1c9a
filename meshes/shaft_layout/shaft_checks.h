/// Refusals of shafts that cannot be meshed.
#pragma once

#include "meshes/shaft_layout/shaft_geometry.h"

namespace meshes {

/// @throws GeometryRefused with the offending numbers (mm) and what to change
void check_shaft(const Shaft& shaft);
void check_control(const ShaftMeshControl& control);

/// About how many cells the mesh will have, from its rows and the sizes along the axis: within 20 % of what
/// is meshed (unit test cell_estimates).
/// @param shaft, control have passed the checks above
double estimated_cells(const Shaft& shaft, const ShaftMeshControl& control);

/// @throws TooManyCells naming largest_cell_m or cells_per_fillet_quarter
void check_cells(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
