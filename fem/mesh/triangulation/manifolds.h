/// The charts of a body as manifolds of its deal.II mesh. Internal to fem.
#pragma once

#include <deal.II/grid/tria.h>

#include <vector>

#include "fem/base/values/body.h"

namespace fem {

/// Gives every cell, face and edge its manifold, in an order that depends on ids only: all flat; then the
/// cells of each cylinder chart with their faces and edges, by ascending volume id (charts agree on what they
/// share: the concentric part; core cells get curved faces where they touch a ring); then the faces of each
/// fillet with their edges, by ascending boundary id.
/// @throws std::invalid_argument if a chart's volume or a torus' boundary group is not in the mesh, or a
/// chart impossible
void attach_charts(dealii::Triangulation<3>& mesh, std::vector<CylinderChart> cylinders,
                   std::vector<TorusChart> tori);

}  // namespace fem
