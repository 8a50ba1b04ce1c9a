#include "kinetics/torsion_chain/jacobi.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "kinetics/values/machine_refused.h"

namespace kinetics::torsion {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Index> falling(const VectorXd& sizes) {
  std::vector<Index> order(sizes.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  return order;
}

void rotate(Eigen::Ref<MatrixXd> a, Index p, Index q, double c, double s) {
  for (Index i = 0; i < a.rows(); ++i) {
    const double x = a(i, p), y = a(i, q);
    a(i, p) = c * x - s * y;
    a(i, q) = s * x + c * y;
  }
}

/// Makes the columns orthogonal; `turned` collects the rotations if it is not empty.
void orthogonalise(MatrixXd& a, MatrixXd& turned) {
  const Index n = a.cols();
  const double round_off = std::numeric_limits<double>::epsilon() * std::sqrt(double(std::max<Index>(n, 1)));
  for (int sweep = 0; sweep < 60; ++sweep) {
    VectorXd norm = a.colwise().norm();
    bool turned_any = false;
    for (Index p = 0; p + 1 < n; ++p)
      for (Index q = p + 1; q < n; ++q) {
        const double cosine = a.col(p).dot(a.col(q)) / norm[p] / norm[q];
        if (std::abs(cosine) <= round_off) continue;
        turned_any = true;
        const double zeta = (norm[q] / norm[p] - norm[p] / norm[q]) / (2 * cosine);
        const double t = (zeta >= 0 ? 1 : -1) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::hypot(1.0, t), s = c * t;
        rotate(a, p, q, c, s);
        if (turned.size() > 0) rotate(turned, p, q, c, s);
        norm[p] = a.col(p).norm();
        norm[q] = a.col(q).norm();
      }
    if (!turned_any) return;
  }
  throw LoadsFailed("natural frequencies of the tree: the Jacobi rotations did not settle in 60 sweeps");
}

}  // namespace

JacobiResult one_sided_jacobi(const MatrixXd& matrix, bool with_vectors) {
  const Index n = matrix.rows(), m = matrix.cols();
  const auto rows = falling(matrix.rowwise().lpNorm<Eigen::Infinity>());
  MatrixXd sorted(n, m);
  for (Index i = 0; i < n; ++i) sorted.row(i) = matrix.row(rows[i]);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(sorted);

  MatrixXd a = MatrixXd::Zero(m, m);
  a.triangularView<Eigen::Lower>() = qr.matrixR().topRows(m).triangularView<Eigen::Upper>().transpose();
  MatrixXd turned = with_vectors ? MatrixXd(MatrixXd::Identity(m, m)) : MatrixXd();
  orthogonalise(a, turned);

  const VectorXd norm = a.colwise().norm();
  const auto order = falling(norm);
  JacobiResult result;
  result.value.resize(m);
  for (Index k = 0; k < m; ++k) result.value[k] = norm[order[k]];
  if (!with_vectors) return result;

  MatrixXd in_q = MatrixXd::Zero(n, m), in_columns(m, m);
  for (Index k = 0; k < m; ++k) {
    in_q.col(k).head(m) = turned.col(order[k]);
    in_columns.col(k) = a.col(order[k]) / norm[order[k]];
  }
  const MatrixXd sorted_left = qr.householderQ() * in_q;
  result.left.resize(n, m);
  for (Index i = 0; i < n; ++i) result.left.row(rows[i]) = sorted_left.row(i);
  result.right = qr.colsPermutation() * in_columns;
  return result;
}

}  // namespace kinetics::torsion
