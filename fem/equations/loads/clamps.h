/// Surfaces held in space: unknowns without displacement. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// The unknowns that the clamps hold, ascending, each once; none without clamps.
/// @throws std::invalid_argument for a group without faces, a clamp that fixes no direction or holds no node,
/// and if together they leave the body a rigid motion, naming it
std::vector<std::int64_t> clamped_unknowns(const Grid& grid, const std::vector<Clamp>& clamps);

/// Zeroes rows and columns of the unknowns and leaves their diagonal.
void clamp(const std::vector<std::int64_t>& unknowns, SymmetricMatrix& matrix);

/// Sets the rows of the unknowns to zero.
void clear_rows(const std::vector<std::int64_t>& unknowns, Eigen::MatrixXd& vectors);

}  // namespace fem
