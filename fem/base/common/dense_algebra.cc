#include "fem/base/common/dense_algebra.h"

#include <Eigen/Dense>

namespace fem {

using Eigen::MatrixXd;

MatrixXd product(const ConstMatrix& a, const ConstMatrix& b) {
  return a * b;
}

MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b) {
  return a.transpose() * b;
}

void subtract_product(const ConstMatrix& a, const ConstMatrix& b, Eigen::Ref<MatrixXd> c) {
  c.noalias() -= a * b;
}

Eigenpairs symmetric_eigenpairs(const ConstMatrix& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> pairs(a);
  return {pairs.eigenvalues(), pairs.eigenvectors()};
}

Eigenpairs symmetric_eigenpairs(const ConstMatrix& a, const ConstMatrix& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> pairs(a, b);
  return {pairs.eigenvalues(), pairs.eigenvectors()};
}

RowSpace row_space(const ConstMatrix& a, double negligible) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  RowSpace result{svd.matrixV(), 0};
  for (const double value : svd.singularValues()) result.rank += value > negligible * svd.singularValues()[0];
  return result;
}

MatrixXd orthonormal_by(const ConstMatrix& gram, const ConstMatrix& x) {
  const Eigen::LLT<MatrixXd> cholesky(gram);
  return cholesky.matrixU().solve<Eigen::OnTheRight>(x);
}

MatrixXd solve_symmetric(const ConstMatrix& a, const ConstMatrix& b) {
  return Eigen::LDLT<MatrixXd>(a).solve(b);
}

std::optional<MatrixXd> solve_symmetric(const ConstMatrix& a, const ConstMatrix& b, double smallest) {
  const Eigen::LDLT<MatrixXd> factors(a);
  if (!(factors.vectorD().minCoeff() > smallest)) return std::nullopt;
  const MatrixXd inverse = factors.solve(MatrixXd::Identity(a.rows(), a.cols()));
  if (!(inverse.diagonal().maxCoeff() < 1 / smallest)) return std::nullopt;
  return factors.solve(b);
}

MatrixXd solve(const ConstMatrix& a, const ConstMatrix& b) {
  return Eigen::PartialPivLU<MatrixXd>(a).solve(b);
}

MatrixXd inverse(const ConstMatrix& a) {
  return Eigen::PartialPivLU<MatrixXd>(a).inverse();
}

MatrixXd solve_with_full_pivoting(const ConstMatrix& a, const ConstMatrix& b) {
  return Eigen::FullPivLU<MatrixXd>(a).solve(b);
}

bool is_invertible(const ConstMatrix& a) {
  return Eigen::FullPivLU<MatrixXd>(a).isInvertible();
}

}  // namespace fem
