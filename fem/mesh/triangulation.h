/// deal.II's triangulation of a coarse mesh. Internal to fem.
#pragma once

#include <deal.II/grid/tria.h>

#include "fem/values/coarse_mesh.h"

namespace fem {

/// @throws MeshUnusable naming what is wrong first: arrays of lengths that do not fit, no cells, a node that
/// does not exist, a place that is not finite, a negative id
void check_arrays(const CoarseMesh& mesh);

/// Fills an empty triangulation: material and boundary ids are those of the mesh, cells keep their order, and
/// nodes that no cell has are left out.
/// @param mesh  hexahedra, checked
/// @throws MeshUnusable if deal.II cannot join the cells
void triangulate(const CoarseMesh& mesh, dealii::Triangulation<3>& triangulation);

}  // namespace fem
