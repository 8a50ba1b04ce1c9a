/// Singular values of a chain's matrix, by LAPACK's bidiagonal QR.
#pragma once

#include <Eigen/Core>

namespace kinetics::torsion {

/// m x (m + 1) matrix: row k holds diagonal[k] in column k and beside[k] in column k + 1.
struct ChainMatrix {
  Eigen::VectorXd diagonal, beside;
};

/// matrix = left diag(value) right^T.
struct SingularValues {
  Eigen::ArrayXd value;   ///< m, falling
  Eigen::MatrixXd left;   ///< m x m; empty without vectors
  Eigen::MatrixXd right;  ///< (m + 1) x m
};

/// Values without vectors take O(m^2); both keep relative accuracy, for the rotations that make the matrix
/// square only multiply and the sweeps of dbdsqr never square. Source: J. Demmel, W. Kahan, "Accurate
/// singular values of bidiagonal matrices" (1990).
/// @throws std::runtime_error if LAPACK does not converge
SingularValues singular_values(const ChainMatrix& matrix, bool with_vectors);

}  // namespace kinetics::torsion
