/// deal.II's triangulation of a coarse mesh. Internal to fem.
#pragma once

#include <deal.II/grid/tria.h>

#include "fem/base/values/coarse_mesh.h"

namespace fem {

/// Fills an empty triangulation: material and boundary ids are those of the mesh, cells keep their order, and
/// nodes that no cell has are left out.
/// @param mesh  hexahedra, checked (check_arrays)
/// @throws MeshUnusable if deal.II cannot join the cells
void triangulate(const CoarseMesh& mesh, dealii::Triangulation<3>& triangulation);

}  // namespace fem
