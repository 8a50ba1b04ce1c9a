/// The nodes and cells of the solution as plain arrays. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/rigid_modes.h"

namespace fem {

/// Cells and faces in VTK's order (vtk_order.h).
Nodes export_nodes(const Grid& grid, const NodeIntegrals& integrals);

/// The same without the nodes' volumes.
Nodes export_nodes(const Grid& grid);

/// Which rows of unit responses.
enum class NodalField { displacement, stress };

/// Load cases, each the sum of all channels times their factors. Called on all ranks for the same nodes.
/// @param nodes         at which they are wanted
/// @param factors       channels x load cases
/// @return nodes x (3 or 6 components per load case)
NodeRows sum_of_channels(const UnitResponses& responses, NodalField field,
                         const std::vector<std::int32_t>& nodes, const Eigen::MatrixXd& factors);

/// At the nodes that this rank has.
NodeRows sum_of_own_channels(const UnitResponses& responses, NodalField field,
                             const Eigen::MatrixXd& factors);

}  // namespace fem
