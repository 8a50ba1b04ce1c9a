#include "fem/equations/operators/mass_matrix.h"

#include <algorithm>
#include <cmath>

#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

/// The matrix of a graph with one unknown per node, filled with zeros.
SymmetricMatrix make_node_matrix(const NodeGraph& graph) {
  SymmetricMatrix matrix;
  matrix.n = static_cast<std::int64_t>(graph.n_nodes());
  matrix.column_begin.assign(1, 0);
  std::vector<std::int64_t> rows;
  for (std::int64_t j = 0; j < matrix.n; ++j) {
    rows.push_back(j);
    rows.insert(rows.end(), graph.neighbour.begin() + graph.begin[j],
                graph.neighbour.begin() + graph.begin[j + 1]);
    matrix.column_begin.push_back(static_cast<std::int64_t>(rows.size()));
  }
  matrix.row = Eigen::Map<const decltype(matrix.row)>(rows.data(), Eigen::Index(rows.size()));
  matrix.value.setZero(matrix.row.size());
  return matrix;
}

double& entry(SymmetricMatrix& matrix, std::int32_t i, std::int32_t j) {
  const auto column = std::min(i, j), row = std::max(i, j);
  const auto begin = matrix.row.begin() + matrix.column_begin[column];
  const auto end = matrix.row.begin() + matrix.column_begin[column + 1];
  return matrix.value[std::lower_bound(begin, end, row) - matrix.row.begin()];
}

}  // namespace

MassMatrix::MassMatrix(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours,
                       const NodeGraph& graph, const PerCell<double>& density_kg_m3)
    : nodes_(make_node_matrix(graph)) {
  // N_i N_j det J has the degree of the second moments' N_i x det J.
  const Tabulation at = moment_points_in_cell(grid.shape());
  const CellCouplings couplings(grid);
  const Eigen::Map<const Eigen::MatrixXd> shapes(at.value.data(), at.n_shapes, at.n_points);
  for (const auto& cells : colours)
    parallel_for(cells.size(), 16, [&](std::size_t begin, std::size_t end) {
      Eigen::MatrixXd scaled, products;
      for (std::size_t c = begin; c < end; ++c) {
        scaled.resize(at.n_shapes, at.n_points);
        for (int q = 0; q < at.n_points; ++q)
          scaled.col(q) = std::sqrt(density_kg_m3[cells[c]] * jacobian(grid, cells[c], at, q).determinant() *
                                    at.weight[q]) *
                          shapes.col(q);
        couplings.couple(std::size_t(cells[c]), 1, scaled);
        products.setZero(scaled.rows(), scaled.rows());
        products.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
        const auto* nodes = couplings.nodes(std::size_t(cells[c]));
        for (int j = 0; j < int(scaled.rows()); ++j)
          for (int i = j; i < int(scaled.rows()); ++i) entry(nodes_, nodes[i], nodes[j]) += products(i, j);
      }
    });
}

Eigen::MatrixXd MassMatrix::operator*(const Eigen::MatrixXd& x) const {
  const auto n = static_cast<Eigen::Index>(nodes_.n);
  // Node by node: x, y, z of each column become columns of their own.
  Eigen::MatrixXd by_node(n, 3 * x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    by_node.middleCols<3>(3 * k) = x.col(k).reshaped(3, n).transpose();
  by_node = multiply(nodes_, by_node);
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    result.col(k).reshaped(3, n) = by_node.middleCols<3>(3 * k).transpose();
  return result;
}

}  // namespace fem
