/// The level of smoothed aggregation below a stiffness between nodes. Internal to fem.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem/aggregates.h"
#include "fem/block_matrix.h"
#include "fem/cholmod_factor.h"

namespace fem {

/// Rigid motions of the aggregates, smoothed by one step of damped Jacobi: P = (1 - damping D^-1 K) Q with
/// 3 x 6 blocks. Whatever K does not resist, rigid motion of the body, stays in its range.
/// @param motions  3 x 6 per node (rigid_motions)
BlockMatrix<float> smoothed_interpolation(const BlockMatrix<double>& stiffness, const Aggregates& aggregates,
                                          const std::vector<double>& motions, double damping);

/// P'K P, its lower triangle by columns, six unknowns per aggregate. One aggregate is held fast, which leaves
/// a free body no rigid motion; what an aggregate's nodes do not tell apart has a one on the diagonal.
struct RigidGalerkin {
  NodeGraph graph;  ///< of aggregates
  SymmetricMatrix matrix;
};
RigidGalerkin rigid_galerkin(const BlockMatrix<double>& stiffness, const BlockMatrix<float>& interpolation,
                             std::int32_t held);

/// Its factor.
/// @throws std::runtime_error as CholmodFactor
std::unique_ptr<CholmodFactor> factorise(const RigidGalerkin& level);

}  // namespace fem
