/// Block Lanczos iteration in the inner product of a mass matrix. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <functional>

namespace fem {

using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// Values descending; vectors with X'MX = I.
struct Eigenpairs {
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;
};

/// The largest eigenvalues of A M, both matrices symmetric, A semidefinite, M definite on the range of A.
/// All basis vectors are kept orthogonal to each other; the block finds eigenvalues repeated up to its width.
/// Fewer pairs than wanted come back only if the space has no more. Starts from fixed pseudo-random vectors.
/// @param n_rows    length of the vectors
/// @param n_wanted  >= 1
/// @param mass      X -> M X
/// @param inverse   F -> A F
/// @throws std::runtime_error if the pairs do not converge
Eigenpairs largest_eigenpairs(Eigen::Index n_rows, int n_wanted, const BlockOperator& mass,
                              const BlockOperator& inverse);

}  // namespace fem
