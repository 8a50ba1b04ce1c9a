/// The nodes and cells of the solution as plain arrays. Internal to fem.
#pragma once

#include "fem/mesh/grid.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/values/unit_responses.h"

namespace fem {

/// Cells and faces in VTK's order (vtk_order.h).
Nodes export_nodes(const Grid& grid, const NodeIntegrals& integrals);

/// The same without the nodes' volumes.
Nodes export_nodes(const Grid& grid);

}  // namespace fem
