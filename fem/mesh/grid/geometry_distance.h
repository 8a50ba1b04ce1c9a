/// How far curved faces of the mesh are from the surfaces that they stand for. Internal to fem.
#pragma once

#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/geometry_error.h"
#include "fem/base/values/unit_load.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Largest distance from its cylinder or torus over the quadrature points of all faces that lie on one: faces
/// of constant radius in a cylinder chart, faces of torus charts, and faces of the given seats.
GeometryError geometry_error(const Grid& grid, const Body& body, const std::vector<LoadSurface>& seats);

}  // namespace fem
