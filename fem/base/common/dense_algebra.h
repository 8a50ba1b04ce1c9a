/// Products and decompositions of dense matrices. Internal to fem.
///
/// Eigen's templates cost a file that names one of them 2 s (a product) to 13 s (singular values); here they
/// are compiled once.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace fem {

using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b);             ///< a b
Eigen::MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b);  ///< a'b
/// c -= a b; c must be neither of them.
void subtract_product(const ConstMatrix& a, const ConstMatrix& b, Eigen::Ref<Eigen::MatrixXd> c);

struct Eigenpairs {
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;  ///< one per column
};
/// Values ascending, vectors orthonormal.
/// @param a  symmetric; its lower triangle is read
Eigenpairs symmetric_eigenpairs(const ConstMatrix& a);
/// A x = w B x: values ascending, X'BX = I.
/// @param b  positive definite; lower triangles are read
Eigenpairs symmetric_eigenpairs(const ConstMatrix& a, const ConstMatrix& b);

/// Right singular vectors, by falling singular value: the first `rank` span the rows of the matrix, the
/// others its null space.
struct RowSpace {
  Eigen::MatrixXd vector;  ///< columns x columns of the matrix, orthonormal
  Eigen::Index rank = 0;
};
/// @param negligible  singular values up to this share of the largest count as zero
RowSpace row_space(const ConstMatrix& a, double negligible);

/// x U^-1 with gram = U'U: columns that are orthonormal in the inner product of their Gram matrix.
/// @param gram  positive definite
Eigen::MatrixXd orthonormal_by(const ConstMatrix& gram, const ConstMatrix& x);

/// A^-1 b by LDL' with pivoting.
/// @param a  symmetric, positive definite; its lower triangle is read
Eigen::MatrixXd solve_symmetric(const ConstMatrix& a, const ConstMatrix& b);
/// The same; none unless all 1 / (A^-1)_ii are larger than `smallest`. In a matrix of scalar products that is
/// the squared distance of each vector from the span of the others, whatever their order; pivots are at
/// least that, and depend on the order.
std::optional<Eigen::MatrixXd> solve_symmetric(const ConstMatrix& a, const ConstMatrix& b, double smallest);

/// A^-1 b by LU with partial pivoting, A invertible.
Eigen::MatrixXd solve(const ConstMatrix& a, const ConstMatrix& b);
Eigen::MatrixXd inverse(const ConstMatrix& a);
/// By LU with full pivoting; one of the solutions if the system is singular to rounding.
Eigen::MatrixXd solve_with_full_pivoting(const ConstMatrix& a, const ConstMatrix& b);
/// To rounding, by LU with full pivoting.
bool is_invertible(const ConstMatrix& a);

}  // namespace fem
