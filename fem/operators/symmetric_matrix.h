/// The stiffness matrix: symmetric, three unknowns per node, lower triangle by columns as CHOLMOD wants it.
/// Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/common/large_memory.h"
#include "fem/mesh/grid.h"

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
  LargeVector<std::int64_t> row;
  LargeVector<double> value;
};

/// The matrix of a graph, filled with zeros, on all threads.
SymmetricMatrix make_matrix(const NodeGraph& graph);

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
