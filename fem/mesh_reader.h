/// From a .msh file and its charts to the nodes of the displacement space. Internal to fem.
#pragma once

#include "fem/body.h"
#include "fem/grid.h"

namespace fem {

/// Reads hexahedra with their physical groups, attaches the charts, places the nodes of Q_k on the curved
/// cells.
/// @throws std::runtime_error if the file cannot be read or has inverted cells
/// @throws std::invalid_argument for a chart without cells or faces, a degree outside 1 to 3
Grid read_grid(const Body& body);

}  // namespace fem
