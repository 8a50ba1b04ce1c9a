/// From the coarse cells of a body and its charts to the nodes of the displacement space. Internal to fem.
#pragma once

#include "fem/base/values/body.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// The cells with their groups. Hexahedra: attaches the charts, refines, places the nodes of Q_k on the
/// curved cells. Quadratic tetrahedra: nodes as they are.
/// @throws MeshUnusable if the arrays are no mesh (check_arrays), a face of tetrahedra has no group, cells
/// are inverted, or the mesh is in several pieces
/// @throws InvertedBesideLarger if body.refinements invert cells beside larger ones
/// @throws std::invalid_argument without a mesh, for a chart without cells or faces, a degree outside 1 to 3,
/// charts, refinements or another degree than 2 with tetrahedra
Grid make_grid(const Body& body);

}  // namespace fem
