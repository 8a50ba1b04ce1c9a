/// Shares of a mesh's cells for MPI ranks. Internal to fem.
#pragma once

#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// The share that each cell falls to, 0 to n_shares - 1: shares are halved by their number across the longest
/// extent, again and again, and have as many cells to one.
/// @param first  cells of share 0 to one of each other share's, above 0 and at most 1
std::vector<int> deal_out_cells(const Grid& grid, int n_shares, double first = 1);

}  // namespace fem
