/// Block Lanczos iteration in the inner product of a mass matrix. Internal to fem.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "fem/common/dense_algebra.h"

namespace fem {

using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// The largest eigenvalues of A M, descending, with X'MX = I; both matrices symmetric, A semidefinite, M
/// definite on the range of A. All basis vectors are kept orthogonal to each other; the block finds
/// eigenvalues repeated up to its width. Fewer pairs than wanted come back only if the space has no more.
/// Starts from fixed pseudo-random vectors.
/// @param n_rows    length of the vectors
/// @param n_wanted  >= 1
/// @param mass      X -> M X
/// @param inverse   F -> A F
/// @throws SolveFailed if the pairs do not converge
Eigenpairs largest_eigenpairs(Eigen::Index n_rows, int n_wanted, const BlockOperator& mass,
                              const BlockOperator& inverse);

}  // namespace fem
