/// The level of smoothed aggregation below a stiffness between nodes. Internal to fem.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem/matrices/block_matrix.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/multigrid/aggregates.h"

namespace fem {

/// The aggregates' displacements, smoothed by one step of damped Jacobi: P = (1 - damping D^-1 K) Q with 3 x
/// 6 blocks. Whatever K does not resist, rigid motion of the body, stays in its range.
/// @param basis  Q, 3 x 6 per node (AggregateMotions)
BlockMatrix<float> smoothed_interpolation(const BlockMatrix<double>& stiffness, const Aggregates& aggregates,
                                          const std::vector<double>& basis, double damping);

/// P'K P in 3 x 3 blocks: an aggregate's six unknowns are two nodes after each other. What an aggregate's
/// nodes do not tell apart has a one on the diagonal.
BlockMatrix<double> galerkin_product(const BlockMatrix<double>& stiffness,
                                     const BlockMatrix<float>& interpolation);

/// Its factor with one aggregate held fast, which leaves a free body no rigid motion.
/// @throws SolveFailed as CholmodFactor
std::unique_ptr<CholmodFactor> factorise_held(const BlockMatrix<double>& stiffness, std::int32_t held);

}  // namespace fem
