#include "fem/operators/symmetric_matrix.h"

#include <algorithm>

#include "fem/common/parallel.h"
#include "fem/mesh/hanging_nodes.h"

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

SymmetricMatrix make_matrix(const NodeGraph& graph) {
  SymmetricMatrix matrix;
  const std::size_t n_nodes = graph.n_nodes();
  matrix.n = static_cast<std::int64_t>(3 * n_nodes);
  matrix.column_begin.assign(1, 0);
  matrix.column_begin.reserve(matrix.n + 1);
  for (std::size_t j = 0; j < n_nodes; ++j)
    for (int c = 0; c < 3; ++c)
      matrix.column_begin.push_back(matrix.column_begin.back() + 3 - c +
                                    3 * (graph.begin[j + 1] - graph.begin[j]));
  matrix.row.resize(matrix.column_begin.back());
  matrix.value.assign(matrix.column_begin.back(), 0.0);
  parallel_for(n_nodes, 1000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (int c = 0; c < 3; ++c) {
        auto* row = matrix.row.data() + matrix.column_begin[3 * j + c];
        for (int a = c; a < 3; ++a) *row++ = static_cast<std::int64_t>(3 * j + a);
        for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k)
          for (int a = 0; a < 3; ++a) *row++ = 3 * std::int64_t(graph.neighbour[k]) + a;
      }
  });
  return matrix;
}

Eigen::MatrixXd multiply(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x) {
  constexpr int width = 8;  // columns that travel together: the matrix is read once for all of them
  using Block = Eigen::Matrix<double, Eigen::Dynamic, width, Eigen::RowMajor>;
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

}  // namespace fem
