#include "tests/benchmarks/calculix/bare_cholmod.h"

#include <cholmod.h>

#include <stdexcept>

namespace measure {

Eigen::MatrixXd solve_with_bare_cholmod(const fem::SymmetricMatrix& matrix,
                                        Eigen::MatrixXd right_hand_sides) {
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));
  cholmod_common common{};
  cholmod_l_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.supernodal = CHOLMOD_SUPERNODAL;

  cholmod_sparse a{};
  a.nrow = a.ncol = std::size_t(matrix.n);
  a.nzmax = matrix.value.size();
  a.p = const_cast<std::int64_t*>(matrix.column_begin.data());
  a.i = const_cast<std::int64_t*>(matrix.row.data());
  a.x = const_cast<double*>(matrix.value.data());
  a.stype = -1;
  a.itype = CHOLMOD_LONG;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  cholmod_dense b{};
  b.nrow = b.d = std::size_t(right_hand_sides.rows());
  b.ncol = std::size_t(right_hand_sides.cols());
  b.nzmax = b.nrow * b.ncol;
  b.x = right_hand_sides.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;

  cholmod_factor* factor = cholmod_l_analyze(&a, &common);
  cholmod_l_factorize(&a, factor, &common);
  cholmod_dense* x = cholmod_l_solve(CHOLMOD_A, factor, &b, &common);
  const bool failed = common.status != CHOLMOD_OK || x == nullptr;
  if (!failed)
    right_hand_sides = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x),
                                                         right_hand_sides.rows(), right_hand_sides.cols());
  cholmod_l_free_dense(&x, &common);
  cholmod_l_free_factor(&factor, &common);
  cholmod_l_finish(&common);
  if (failed) throw std::runtime_error("bare CHOLMOD failed");
  return right_hand_sides;
}

}  // namespace measure
