#include "fem/equations/matrices/symmetric_matrix.h"

#include <algorithm>

#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/hanging_nodes.h"

namespace fem {

NodeGraph make_node_graph(const Grid& grid, const CellsOfNodes& cells) {
  const CellCouplings couplings(grid);
  const CellsOfNodes of_hanging = grid.hanging.n() > 0 ? cells_that_couple(grid, couplings) : CellsOfNodes{};
  const CellsOfNodes& coupled = grid.hanging.n() > 0 ? of_hanging : cells;
  std::vector<std::vector<std::int32_t>> larger(grid.n_nodes);
  parallel_for(grid.n_nodes, 500, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> found;
    for (std::size_t node = begin; node < end; ++node) {
      found.clear();
      for (auto k = coupled.begin[node]; k < coupled.begin[node + 1]; ++k) {
        const auto cell = std::size_t(coupled.cell[k]);
        const auto* nodes = couplings.nodes(cell);
        for (int i = 0; i < couplings.n_nodes(cell); ++i)
          if (nodes[i] > static_cast<std::int32_t>(node)) found.push_back(nodes[i]);
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      larger[node] = found;
    }
  });
  NodeGraph graph;
  graph.begin.assign(1, 0);
  for (const auto& list : larger)
    graph.begin.push_back(graph.begin.back() + static_cast<std::int64_t>(list.size()));
  graph.neighbour.reserve(graph.begin.back());
  for (const auto& list : larger) graph.neighbour.insert(graph.neighbour.end(), list.begin(), list.end());
  return graph;
}

std::vector<std::int32_t> places_in(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> place(order.size());
  for (std::size_t p = 0; p < order.size(); ++p) place[std::size_t(order[p])] = std::int32_t(p);
  return place;
}

NodeGraph permuted(const NodeGraph& graph, const std::vector<std::int32_t>& order) {
  const auto place = places_in(order);
  const std::size_t n_nodes = order.size();
  const auto for_each_edge = [&](const auto& take) {
    for (std::size_t j = 0; j < n_nodes; ++j)
      for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k) {
        const auto own = place[j], other = place[std::size_t(graph.neighbour[std::size_t(k)])];
        take(std::size_t(std::min(own, other)), std::max(own, other));
      }
  };
  NodeGraph result;
  result.begin.assign(n_nodes + 1, 0);
  for_each_edge([&](std::size_t smaller, std::int32_t) { ++result.begin[smaller + 1]; });
  for (std::size_t p = 0; p < n_nodes; ++p) result.begin[p + 1] += result.begin[p];
  result.neighbour.resize(graph.neighbour.size());
  std::vector<std::int64_t> next(result.begin.begin(), result.begin.end() - 1);
  for_each_edge([&](std::size_t smaller, std::int32_t larger) {
    result.neighbour[std::size_t(next[smaller]++)] = larger;
  });
  parallel_for(n_nodes, 500, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      std::sort(result.neighbour.begin() + result.begin[p], result.neighbour.begin() + result.begin[p + 1]);
  });
  return result;
}

namespace {

/// Calls take(row of the mesh, row in the other order, column) for the three rows of each node.
template <class Take>
void for_each_row(const std::vector<std::int32_t>& place, Eigen::Index n_columns, const Take& take) {
  parallel_for(std::size_t(n_columns), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t i = 0; i < place.size(); ++i)
        for (int d = 0; d < 3; ++d)
          take(3 * Eigen::Index(i) + d, 3 * Eigen::Index(place[i]) + d, Eigen::Index(k));
  });
}

}  // namespace

Eigen::MatrixXd rows_in_order(const Eigen::MatrixXd& rows, const std::vector<std::int32_t>& place) {
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for_each_row(place, rows.cols(),
               [&](auto of_mesh, auto row, auto k) { result(row, k) = rows(of_mesh, k); });
  return result;
}

Eigen::MatrixXd rows_of_mesh(const Eigen::MatrixXd& rows, const std::vector<std::int32_t>& place) {
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for_each_row(place, rows.cols(),
               [&](auto of_mesh, auto row, auto k) { result(of_mesh, k) = rows(row, k); });
  return result;
}

SymmetricMatrix make_matrix(const NodeGraph& graph) {
  SymmetricMatrix matrix;
  const std::size_t n_nodes = graph.n_nodes();
  matrix.n = static_cast<std::int64_t>(3 * n_nodes);
  matrix.column_begin.resize(3 * n_nodes + 1);
  matrix.column_begin.back() = 9 * graph.begin.back() + 6 * static_cast<std::int64_t>(n_nodes);
  matrix.row.resize(matrix.column_begin.back());
  matrix.value.resize(matrix.column_begin.back());
  parallel_for(n_nodes, 1000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      auto at = 9 * graph.begin[j] + 6 * static_cast<std::int64_t>(j);
      for (int c = 0; c < 3; ++c) {
        matrix.column_begin[3 * j + c] = at;
        for (int a = c; a < 3; ++a) matrix.row[at++] = static_cast<std::int64_t>(3 * j + a);
        for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k)
          for (int a = 0; a < 3; ++a) matrix.row[at++] = 3 * std::int64_t(graph.neighbour[k]) + a;
      }
      std::fill(matrix.value.begin() + matrix.column_begin[3 * j], matrix.value.begin() + at, 0.0);
    }
  });
  return matrix;
}

void add_block(const NodeGraph& graph, std::int32_t row_node, std::int32_t column_node,
               const Eigen::Matrix3d& block, SymmetricMatrix& matrix) {
  if (row_node < column_node) return add_block(graph, column_node, row_node, block.transpose(), matrix);
  const auto column = [&](int c) {
    return matrix.value.data() + matrix.column_begin[3 * std::int64_t(column_node) + c];
  };
  if (row_node == column_node) {
    for (int c = 0; c < 3; ++c)
      for (int a = c; a < 3; ++a) column(c)[a - c] += block(a, c);
    return;
  }
  const auto begin = graph.neighbour.begin() + graph.begin[column_node];
  const auto end = graph.neighbour.begin() + graph.begin[column_node + 1];
  const auto place = std::lower_bound(begin, end, row_node) - begin;
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < 3; ++a) column(c)[3 - c + 3 * place + a] += block(a, c);
}

namespace {

NodeGraph graph_of(const SymmetricMatrix& matrix) {
  NodeGraph graph;
  graph.begin.push_back(0);
  for (std::int64_t j = 0; j < matrix.n; j += 3) {
    for (auto k = matrix.column_begin[j] + 3; k < matrix.column_begin[j + 1]; k += 3)
      graph.neighbour.push_back(std::int32_t(matrix.row[k] / 3));
    graph.begin.push_back(std::int64_t(graph.neighbour.size()));
  }
  return graph;
}

}  // namespace

SymmetricMatrix permuted(const SymmetricMatrix& matrix, const std::vector<std::int32_t>& order) {
  const NodeGraph in_order = permuted(graph_of(matrix), order);
  const auto place = places_in(order);
  SymmetricMatrix result = make_matrix(in_order);
  parallel_for(order.size(), 500, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for_blocks_of(matrix, j, [&](std::int32_t i, const Eigen::Matrix3d& block) {
        add_block(in_order, place[i], place[j], block, result);
      });
  });
  return result;
}

namespace {

/// Columns that travel together: the matrix is read once for all of them.
template <int width>
Eigen::MatrixXd multiply_by_blocks(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x) {
  using Block = Eigen::Matrix<double, Eigen::Dynamic, width, width == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::MatrixXd y(matrix.n, x.cols());
  const std::size_t n_blocks = (x.cols() + width - 1) / width;
  parallel_for(n_blocks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto first = static_cast<Eigen::Index>(block) * width;
      const auto columns = std::min<Eigen::Index>(width, x.cols() - first);
      Block in = Block::Zero(matrix.n, width), out = Block::Zero(matrix.n, width);
      in.leftCols(columns) = x.middleCols(first, columns);
      for (std::int64_t j = 0; j < matrix.n; ++j) {
        auto k = matrix.column_begin[j];
        const Eigen::Matrix<double, 1, width> in_j = in.row(j);
        Eigen::Matrix<double, 1, width> sum = matrix.value[k] * in_j;
        for (++k; k < matrix.column_begin[j + 1]; ++k) {
          const auto i = matrix.row[k];
          sum += matrix.value[k] * in.row(i);
          out.row(i) += matrix.value[k] * in_j;
        }
        out.row(j) += sum;
      }
      y.middleCols(first, columns) = out.leftCols(columns);
    }
  });
  return y;
}

}  // namespace

Eigen::MatrixXd multiply(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x) {
  if (x.cols() == 1) return multiply_by_blocks<1>(matrix, x);
  if (x.cols() <= 4) return multiply_by_blocks<4>(matrix, x);
  return multiply_by_blocks<8>(matrix, x);
}

}  // namespace fem
