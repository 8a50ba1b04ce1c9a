/// The section's cells as a deal.II mesh, cut where the body asks for it. Internal to fem.
#pragma once

#include <deal.II/grid/tria.h>

#include "fem/models/axisymmetric/meridian_body.h"

namespace fem {

/// Arcs get the manifold of their boundary id, all else is straight; the axis has the boundary id 0. Cells
/// and vertices of the first level have the indices that they have in `body`.
/// @throws std::invalid_argument if an edge belongs to no cell
void make_meridian_mesh(const MeridianBody& body, dealii::Triangulation<2>& mesh);

}  // namespace fem
