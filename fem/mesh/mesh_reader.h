/// From a .msh file and its charts to the nodes of the displacement space. Internal to fem.
#pragma once

#include "fem/mesh/grid.h"
#include "fem/values/body.h"

namespace fem {

/// The cells with their physical groups. Hexahedra: attaches the charts, places the nodes of Q_k on the
/// curved cells. Quadratic tetrahedra (what the file holds decides): nodes as they are.
/// @throws MeshUnusable if the file cannot be read, mixes kinds of cells, lacks groups, or has inverted
/// cells
/// @throws InvertedBesideLarger if body.refinements invert cells beside larger ones
/// @throws std::invalid_argument for a chart without cells or faces, a degree outside 1 to 3, charts or
/// another degree than 2 with tetrahedra
Grid read_grid(const Body& body);

}  // namespace fem
