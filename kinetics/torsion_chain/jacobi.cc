#include "kinetics/torsion_chain/jacobi.h"

#include <algorithm>
#include <string>
#include <vector>

#include "kinetics/values/machine_refused.h"

extern "C" void dgejsv_(const char* joba, const char* jobu, const char* jobv, const char* jobr,
                        const char* jobt, const char* jobp, const int* m, const int* n, double* a,
                        const int* lda, double* sva, double* u, const int* ldu, double* v, const int* ldv,
                        double* work, const int* lwork, int* iwork, int* info);

namespace kinetics::torsion {

SingularValues jacobi_singular_values(Eigen::MatrixXd matrix, bool with_vectors) {
  const int m = int(matrix.rows()), n = int(matrix.cols());
  const int n_work = std::max({2 * m + n, 6 * n + 2 * n * n, 7});
  SingularValues result{Eigen::ArrayXd(n), Eigen::MatrixXd(m, n), Eigen::MatrixXd(n, n)};
  std::vector<double> work(std::size_t(n_work), 0.0);
  std::vector<int> integers(std::size_t(m + 3 * n));
  int info = 0;
  dgejsv_("F", with_vectors ? "U" : "N", with_vectors ? "V" : "N", "N", "N", "N", &m, &n, matrix.data(), &m,
          result.value.data(), result.left.data(), &m, result.right.data(), &n, work.data(), &n_work,
          integers.data(), &info);
  if (info != 0)
    throw LoadsFailed("natural frequencies of the tree: LAPACK dgejsv failed with info = " +
                      std::to_string(info));
  result.value *= work[0] / work[1];
  return result;
}

}  // namespace kinetics::torsion
