#include "kinetics/torsion_chain/dense_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace kinetics::torsion {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd weighted_gram(const ConstMatrix& x, const Eigen::ArrayXd& weight) {
  const MatrixXd weighted = weight.matrix().asDiagonal() * x;
  return x.transpose() * weighted;
}

Eigenpairs symmetric_eigenpairs(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> pairs(a, b);
  return {pairs.eigenvalues(), pairs.eigenvectors()};
}

double smallest_eigenvalue(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

Eigen::VectorXcd solve(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b) {
  return Eigen::PartialPivLU<Eigen::MatrixXcd>(a).solve(b);
}

VectorXd solve_with_full_pivoting(const MatrixXd& a, const VectorXd& b) {
  return Eigen::FullPivLU<MatrixXd>(a).solve(b);
}

Cholesky::Cholesky(const MatrixXd& a) : factor_(a) {}

VectorXd Cholesky::solve(const VectorXd& b) const {
  return factor_.solve(b);
}

MatrixXd Cholesky::inverse() const {
  return factor_.solve(MatrixXd::Identity(factor_.rows(), factor_.rows()));
}

}  // namespace kinetics::torsion
