/// Singular values of a tree's matrix, by LAPACK's Jacobi rotations.
#pragma once

#include "kinetics/torsion_chain/bidiagonal.h"

namespace kinetics::torsion {

/// Rows sorted by size and a QR factorisation with column pivoting take scalings of rows and columns out of
/// the way, then rotations: graded matrices keep the relative accuracy of every value. Source: Z. Drmac, K.
/// Veselic, "New fast and accurate Jacobi SVD algorithm I" (2008), as LAPACK's dgejsv.
/// @param matrix  at least as many rows as columns, full rank
/// @throws LoadsFailed if LAPACK does not converge
SingularValues jacobi_singular_values(Eigen::MatrixXd matrix, bool with_vectors);

}  // namespace kinetics::torsion
