/// Which cells have faces in common, and whether a mesh hangs together. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// The cell beyond each face, n_faces() for every cell; -1 at the boundary. Of a mesh without hanging nodes.
std::vector<std::int32_t> cells_beyond_faces(const Grid& grid);

/// Cells hang together by whole faces: by an edge or a corner they only touch, which carries no moment.
/// @param grid  without hanging nodes
/// @throws MeshUnusable if the mesh has several pieces, with the size and a place of each
void refuse_several_pieces(const Grid& grid);

}  // namespace fem
