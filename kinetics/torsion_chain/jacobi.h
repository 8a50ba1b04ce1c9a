/// Singular values by one-sided Jacobi rotations.
#pragma once

#include <Eigen/Core>

namespace kinetics::torsion {

/// matrix = left diag(value) right^T.
struct JacobiResult {
  Eigen::ArrayXd value;   ///< falling
  Eigen::MatrixXd left;   ///< rows x columns; empty without vectors
  Eigen::MatrixXd right;  ///< columns x columns
};

/// Rows sorted by size and a QR factorisation with column pivoting take scalings of rows and columns out of
/// the way; rotations then make the rows of R orthogonal to each other, to round-off of each pair's own
/// norms. So graded matrices keep the relative accuracy of every value. Source: Z. Drmac, K. Veselic, "New
/// fast and accurate Jacobi SVD algorithm I" (2008); N. J. Higham, "QR factorization with complete pivoting
/// and accurate computation of the SVD" (2000).
/// @param matrix  at least as many rows as columns, full rank
/// @throws std::runtime_error if 60 sweeps do not suffice
JacobiResult one_sided_jacobi(const Eigen::MatrixXd& matrix, bool with_vectors);

}  // namespace kinetics::torsion
