/// Whether a mesh hangs together. Internal to fem.
#pragma once

#include "fem/mesh/grid.h"

namespace fem {

/// Cells hang together by whole faces: by an edge or a corner they only touch, which carries no moment.
/// @throws MeshUnusable if the mesh has several pieces, with the size and a place of each
void refuse_several_pieces(const Grid& grid);

}  // namespace fem
