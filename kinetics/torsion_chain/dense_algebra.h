/// Decompositions of dense matrices: Eigen's templates cost a file that names one of them up to 10 s, here
/// they are compiled once.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace kinetics::torsion {

using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// The matrix X' diag(weight) X.
Eigen::MatrixXd weighted_gram(const ConstMatrix& x, const Eigen::ArrayXd& weight);

struct Eigenpairs {
  Eigen::VectorXd value;   ///< rising
  Eigen::MatrixXd vector;  ///< one per column, X'BX = I
};
/// A x = w B x, both symmetric, B positive definite.
Eigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// @param a  symmetric
double smallest_eigenvalue(const Eigen::MatrixXd& a);

/// A^-1 b by LU with partial pivoting.
Eigen::VectorXcd solve(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b);
/// Solves A x = b by LU with full pivoting; one of the solutions if A is singular to round-off.
Eigen::VectorXd solve_with_full_pivoting(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// A positive definite matrix, factorised once.
class Cholesky {
public:
  explicit Cholesky(const Eigen::MatrixXd& a);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd inverse() const;

private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace kinetics::torsion
