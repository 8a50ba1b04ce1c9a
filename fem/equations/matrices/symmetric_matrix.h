/// The stiffness matrix: symmetric, three unknowns per node, lower triangle by columns as CHOLMOD wants it.
/// Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// Neighbours of every node in the mesh that have a larger number, ascending. Masters stand for the nodes
/// that hang on them; these have no neighbours.
struct NodeGraph {
  std::vector<std::int64_t> begin;  ///< n_nodes + 1
  std::vector<std::int32_t> neighbour;
  std::size_t n_nodes() const noexcept { return begin.size() - 1; }
};
NodeGraph make_node_graph(const Grid& grid, const CellsOfNodes& cells);

/// Where each node comes to stand in an order of nodes.
/// @param order  a node for each position
std::vector<std::int32_t> places_in(const std::vector<std::int32_t>& order);

/// The graph with its nodes in another order, on all threads.
/// @param order  node p of the result is node order[p] of the graph; each node once
NodeGraph permuted(const NodeGraph& graph, const std::vector<std::int32_t>& order);

/// Column 3 j + c holds the rows 3 j + c .. 3 j + 2, then three rows for every larger neighbour of node j.
struct SymmetricMatrix {
  std::int64_t n = 0;
  std::vector<std::int64_t> column_begin;
  Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1> row;
  Eigen::VectorXd value;
};

/// Calls take(row node, block) for the blocks of a node's columns, rows ascending; the first one, of the node
/// itself, is symmetric.
template <typename Take>
void for_blocks_of(const SymmetricMatrix& matrix, std::size_t node, const Take& take) {
  const auto column = [&](int c) { return std::size_t(matrix.column_begin[3 * node + std::size_t(c)]); };
  Eigen::Matrix3d block;
  for (int c = 0; c < 3; ++c)
    for (int a = c; a < 3; ++a) block(a, c) = block(c, a) = matrix.value[column(c) + std::size_t(a - c)];
  take(std::int32_t(node), block);
  for (std::size_t k = 3; column(0) + k < column(1); k += 3) {
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < 3; ++a) block(a, c) = matrix.value[column(c) + k + std::size_t(a) - std::size_t(c)];
    take(std::int32_t(matrix.row[column(0) + k] / 3), block);
  }
}

/// The matrix of a graph, filled with zeros, on all threads.
SymmetricMatrix make_matrix(const NodeGraph& graph);

/// Adds a block to the rows of one node and the columns of another, and its transpose to the rows of this and
/// the columns of that. Of a node with itself: symmetric.
void add_block(const NodeGraph& graph, std::int32_t row_node, std::int32_t column_node,
               const Eigen::Matrix3d& block, SymmetricMatrix& matrix);

/// Three rows per node in another order of nodes, and back, on all threads.
/// @param place  of each node in that order
Eigen::MatrixXd rows_in_order(const Eigen::MatrixXd& rows, const std::vector<std::int32_t>& place);
Eigen::MatrixXd rows_of_mesh(const Eigen::MatrixXd& rows, const std::vector<std::int32_t>& place);

/// The matrix with its nodes in another order, on all threads.
/// @param order  node p of the result is node order[p] of the matrix; each node once
SymmetricMatrix permuted(const SymmetricMatrix& matrix, const std::vector<std::int32_t>& order);

/// K X for all columns of X; the same bits for every number of threads.
Eigen::MatrixXd multiply(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x);

}  // namespace fem
