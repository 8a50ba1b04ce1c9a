/// Whether the arrays of a coarse mesh are one. Internal to fem.
#pragma once

#include "fem/base/values/coarse_mesh.h"

namespace fem {

/// @throws MeshUnusable naming what is wrong first: arrays of lengths that do not fit, no cells, a node that
/// does not exist, a place that is not finite, a negative id
void check_arrays(const CoarseMesh& mesh);

}  // namespace fem
