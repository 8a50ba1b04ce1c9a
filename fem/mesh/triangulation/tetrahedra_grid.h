/// Meshes of quadratic tetrahedra, which are computed on as they are. Internal to fem.
#pragma once

#include "fem/base/values/coarse_mesh.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Cells and their nodes in the mesh's order; nodes that no cell has are left out, and so are faces inside
/// the body.
/// @param mesh  tetrahedra, checked (check_arrays)
/// @throws MeshUnusable naming the place of a face of the surface that is in no group
Grid tetrahedra_grid(const CoarseMesh& mesh);

}  // namespace fem
