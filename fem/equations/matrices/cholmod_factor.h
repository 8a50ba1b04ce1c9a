/// Sparse Cholesky factorisation of the stiffness with CHOLMOD (supernodal), ordered by METIS on the graph of
/// nodes. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "fem/base/values/solver_choice.h"
#include "fem/equations/matrices/symmetric_matrix.h"

namespace fem {

/// Factorisations below stay on one thread: CHOLMOD's many small products gain little from more, and BLAS
/// threads wait for each other by yielding, which beside any other program costs five to ten times the
/// seconds.
constexpr double flops_worth_threads = 3e11;

/// Nested dissection of the nodes: position p of the new order is node result[p].
/// @throws SolveFailed if METIS fails; DoesNotFit as refuse_large_graph
std::vector<std::int32_t> order_nodes(const NodeGraph& graph);

/// METIS counts each pair of neighbours twice, in 32 bits.
/// @param n_pairs  of neighbours
/// @throws DoesNotFit naming the pairs, how many can be counted, and the remedy
void refuse_large_graph(std::size_t n_pairs);

class CholmodFactor {
public:
  /// Finds the shape of the factor.
  /// @param graph       of the nodes
  /// @param node_order  by order_nodes
  /// @throws SolveFailed if memory does not suffice
  CholmodFactor(const NodeGraph& graph, const std::vector<std::int32_t>& node_order);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// The factor's own order of the nodes, from the one given: each node after those that it is eliminated
  /// after.
  const std::vector<std::int32_t>& node_order() const;

  /// Takes the memory of the entries; factorising does it otherwise.
  /// @throws SolveFailed if memory does not suffice
  void take_memory();

  /// @param matrix  of the graph
  /// @throws SolveFailed if the matrix is not positive definite or memory does not suffice; OutOfTime, before
  ///   it begins, if its flops would take longer than there is until a deadline
  void factorise(const SymmetricMatrix& matrix);

  /// @param matrix  of the graph with its nodes in node_order(): nothing is copied
  /// @throws SolveFailed as factorise
  void factorise_in_order(const SymmetricMatrix& matrix);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const;

  /// The same in place, with rows of nodes in node_order().
  /// @param columns  right-hand sides on entry, solutions on exit
  void solve_in_order(Eigen::MatrixXd& columns) const;

  double gigabytes() const;

  /// What the analysis found.
  FactorSize size() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fem
