/// Sparse Cholesky factorisation of the stiffness with CHOLMOD (supernodal), ordered by METIS on the graph of
/// nodes. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "fem/operators/symmetric_matrix.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// Nested dissection of the nodes: position p of the new order is node result[p].
/// @throws SolveFailed if METIS fails
std::vector<std::int32_t> order_nodes(const NodeGraph& graph);

class CholmodFactor {
public:
  /// Finds the shape of the factor. The matrix has to outlive factorise() only.
  /// @throws SolveFailed if memory does not suffice
  CholmodFactor(const SymmetricMatrix& matrix, const std::vector<std::int32_t>& node_order);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// @throws SolveFailed if the matrix is not positive definite or memory does not suffice
  void factorise(const SymmetricMatrix& matrix);

  /// All columns, in blocks that bound the memory.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const;

  double gigabytes() const;

  /// What the analysis found.
  FactorSize size() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fem
