#include "kinetics/torsion_chain/bidiagonal.h"

#include <cmath>
#include <string>
#include <vector>

#include "kinetics/values/machine_refused.h"

extern "C" void dbdsqr_(const char* uplo, const int* n, const int* ncvt, const int* nru, const int* ncc,
                        double* d, double* e, double* vt, const int* ldvt, double* u, const int* ldu,
                        double* c, const int* ldc, double* work, int* info);

namespace kinetics::torsion {
namespace {

using Eigen::Index;

struct Rotation {
  double c, s;
};

/// Rotates the transpose, (m + 1) x m with the entries below its diagonal, to an upper bidiagonal square.
std::vector<Rotation> make_square(Eigen::VectorXd& d, const Eigen::VectorXd& below, Eigen::VectorXd& above) {
  std::vector<Rotation> rotations(d.size());
  for (Index k = 0; k < d.size(); ++k) {
    const double r = std::hypot(d[k], below[k]);
    rotations[k] = {d[k] / r, below[k] / r};
    d[k] = r;
    if (k + 1 == d.size()) break;
    above[k] = rotations[k].s * d[k + 1];
    d[k + 1] *= rotations[k].c;
  }
  return rotations;
}

void dbdsqr(Eigen::VectorXd& d, Eigen::VectorXd& e, Eigen::MatrixXd* vt, Eigen::MatrixXd* u) {
  const int n = static_cast<int>(d.size()), none = 0, one = 1;
  const int n_vectors = vt ? n : 0, lead = vt ? n : 1;
  Eigen::VectorXd work(8 * n);
  double unused = 0;
  int info = 0;
  dbdsqr_("U", &n, &n_vectors, &n_vectors, &none, d.data(), e.data(), vt ? vt->data() : &unused, &lead,
          u ? u->data() : &unused, &lead, &unused, &one, work.data(), &info);
  if (info != 0)
    throw LoadsFailed("natural frequencies of the chain: LAPACK dbdsqr failed with info = " +
                      std::to_string(info));
}

}  // namespace

SingularValues singular_values(const ChainMatrix& matrix, bool with_vectors) {
  const Index m = matrix.diagonal.size();
  if (m == 0) return {Eigen::ArrayXd(0), Eigen::MatrixXd(0, 0), Eigen::MatrixXd(1, 0)};
  Eigen::VectorXd d = matrix.diagonal, e = Eigen::VectorXd::Zero(m);
  const auto rotations = make_square(d, matrix.beside, e);
  Eigen::VectorXd values = d, beside = e;
  dbdsqr(values, beside, nullptr, nullptr);
  SingularValues result{values.array(), {}, {}};
  if (!with_vectors) return result;

  Eigen::MatrixXd vt = Eigen::MatrixXd::Identity(m, m), u = vt;
  dbdsqr(d, e, &vt, &u);
  result.left = vt.transpose();
  result.right = Eigen::MatrixXd::Zero(m + 1, m);
  result.right.topRows(m) = u;
  for (Index k = m - 1; k >= 0; --k) {
    const auto [c, s] = rotations[k];
    const Eigen::RowVectorXd upper = result.right.row(k), lower = result.right.row(k + 1);
    result.right.row(k) = c * upper - s * lower;
    result.right.row(k + 1) = s * upper + c * lower;
  }
  return result;
}

}  // namespace kinetics::torsion
