/// Conjugate gradients for a block of load cases that advance together, each with its own step lengths.
/// Internal to fem.
#pragma once

#include <Eigen/Dense>

#include "fem/multigrid/polynomial_multigrid.h"
#include "fem/operators/block_vector.h"
#include "fem/operators/elastic_operator.h"

namespace fem {

struct BlockCgControl {
  Eigen::ArrayXd tolerance;  ///< largest |f - K u| allowed, per load case
  int max_iterations = 100;
};

enum class BlockCgEnd {
  converged,
  too_many_iterations,  ///< or they are foreseen
  not_falling,          ///< in some iterations in a row the residual did not fall by a tenth
  broke_down,           ///< a number that is not finite or not positive where it has to be
};

struct BlockCgResult {
  BlockCgEnd end = BlockCgEnd::converged;
  int n_iterations = 0;
  std::size_t bytes = 0;  ///< of vectors and work space
};

/// Solves K u = f for f in the range of K: u is one of the solutions. Load cases that have converged stay as
/// they are. The preconditioner's rounding is allowed for (Polak-Ribiere).
/// @param u  the start; the solution on return
/// @param r  f - K u on entry; the residual as updated, not as computed anew, on return
BlockCgResult solve_block(const ElasticOperator<double>& stiffness, const PolynomialMultigrid& preconditioner,
                          const kernel::Kernels& kernels, const Lanes& lanes, const BlockCgControl& control,
                          BlockVector<double>& u, BlockVector<double>& r);

/// r -= K u: on entry the forces.
/// @return |r|^2 per lane
Eigen::ArrayXd subtract_image(const ElasticOperator<double>& stiffness, const kernel::Kernels& kernels,
                              const Lanes& lanes, BlockVector<double>& u, BlockVector<double>& r);

}  // namespace fem
