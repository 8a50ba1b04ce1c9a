/// Where stress is sampled for recovery. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/cell_stress.h"
#include "fem/grid.h"

namespace fem {

/// The k^3 Gauss points of every cell, cell after cell, then the k x k Gauss points of every free face: there
/// stress is of a higher order than elsewhere.
struct StressSamples {
  Points position;                                 ///< 3 x samples
  std::vector<std::int32_t> cell;                  ///< of each sample
  std::vector<std::vector<std::int32_t>> of_cell;  ///< samples in each cell and on its free faces
};

/// Boundary faces of the groups that no load acts on.
std::vector<BoundaryFace> free_faces(const Grid& grid, const std::vector<int>& loaded_groups);

StressSamples make_samples(const Grid& grid, const std::vector<BoundaryFace>& free);

/// Stress at the samples (samples x 6 K).
RowMajor stress_at_samples(const Grid& grid, const std::vector<BoundaryFace>& free, const Lame& elastic,
                           const ConstBlock& displacement);

}  // namespace fem
