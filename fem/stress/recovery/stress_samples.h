/// Where stress is sampled for recovery. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid/grid.h"
#include "fem/stress/cells/cell_stress.h"

namespace fem {

/// The stress points of every cell, cell after cell, then those of every free face: k^3 and k x k Gauss
/// points, where stress is of a higher order than elsewhere; 6 and 4 on tetrahedra.
struct StressSamples {
  Points position;                                 ///< 3 x samples
  std::vector<std::int32_t> cell;                  ///< of each sample
  std::vector<std::vector<std::int32_t>> of_cell;  ///< samples in each cell and on its free faces
};

/// Boundary faces of the groups that no load acts on.
std::vector<BoundaryFace> free_faces(const Grid& grid, const std::vector<int>& loaded_groups);

StressSamples make_samples(const Grid& grid, const std::vector<BoundaryFace>& free);

/// Stress at the samples (samples x 6 K).
RowMajor stress_at_samples(const Grid& grid, const std::vector<BoundaryFace>& free,
                           const PerCell<Lame>& elastic, const ConstBlock& displacement);

}  // namespace fem
