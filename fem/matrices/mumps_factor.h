/// Sparse Cholesky factorisation of the stiffness over several MPI ranks with MUMPS. Internal to fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <vector>

#include "fem/matrices/symmetric_matrix.h"

namespace fem {

/// Each rank enters the stiffness of its own cells; MUMPS adds up. Everything is called on all ranks, and
/// fails on all of them together. Sums are taken as messages arrive: the last digits may change from run to
/// run.
class MumpsFactor {
public:
  /// @param n       unknowns of the body
  /// @param matrix  of this rank's cells; must outlive the constructor only
  /// @param node    number in the body of each of its nodes
  /// @param node_order  rank 0: nested dissection of the body's nodes (order_nodes); read there only
  /// @throws FailedTogether if the matrix is not positive definite or memory does not suffice
  MumpsFactor(MPI_Comm communicator, std::int64_t n, const SymmetricMatrix& matrix,
              const std::vector<std::int32_t>& node, const std::vector<std::int32_t>& node_order);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Rank 0: right-hand sides by columns, replaced by the solutions. Elsewhere not looked at.
  void solve(Eigen::MatrixXd& columns) const;

  /// Of this rank's share of the factor.
  double bytes() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fem
