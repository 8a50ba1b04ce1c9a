#include "fem/coarse_space.h"

#include <future>
#include <numeric>
#include <utility>

#include "fem/cell_geometry.h"
#include "fem/parallel.h"

namespace fem {

namespace {

/// The mesh of corners, numbered in the order of the fine nodes' places.
Grid corner_grid(const Grid& grid, const CellOrder& order, std::vector<std::int32_t>& coarse_of_place) {
  const auto corners = corner_nodes(grid.shape());
  std::vector<char> is_corner(grid.n_nodes, 0);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corners) is_corner[order.node_place[grid.nodes_of(c)[i]]] = 1;
  coarse_of_place.assign(grid.n_nodes, -1);
  Grid coarse;
  coarse.kind = grid.kind;
  coarse.degree = 1;
  for (std::size_t place = 0; place < grid.n_nodes; ++place)
    if (is_corner[place]) coarse_of_place[place] = static_cast<std::int32_t>(coarse.n_nodes++);
  coarse.xyz_m.resize(3 * coarse.n_nodes);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corners) {
      const auto node = grid.nodes_of(c)[i];
      const auto which = coarse_of_place[order.node_place[node]];
      coarse.cell_nodes.push_back(which);
      for (int d = 0; d < 3; ++d) coarse.xyz_m[3 * std::size_t(which) + d] = grid.position(node)[d];
    }
  coarse.volume_id = grid.volume_id;
  return coarse;
}

NodeMatrix make_interpolation(const Grid& grid, const CellOrder& order, const Grid& coarse) {
  const Tabulation nodes = nodes_in_cell(grid.shape());
  const int n_local = grid.nodes_per_cell();
  struct Row {
    std::int32_t cell = -1;
    int local = 0;
  };
  std::vector<Row> row(grid.n_nodes);
  for (std::size_t c = grid.n_cells(); c-- > 0;)
    for (int i = 0; i < n_local; ++i)
      row[order.node_place[grid.nodes_of(c)[i]]] = {static_cast<std::int32_t>(c), i};
  NodeMatrix matrix;
  matrix.begin.push_back(0);
  for (const auto& [cell, local] : row) {
    const auto hats = corner_hats(grid.shape(), nodes.point[local]);
    for (int k = 0; k < 8; ++k)
      if (hats[k] > 1e-12) {
        matrix.column.push_back(coarse.nodes_of(cell)[k]);
        matrix.weight.push_back(static_cast<float>(hats[k]));
      }
    matrix.begin.push_back(static_cast<std::int64_t>(matrix.column.size()));
  }
  return matrix;
}

NodeMatrix transpose(const NodeMatrix& matrix, std::size_t n_columns) {
  NodeMatrix result;
  result.begin.assign(n_columns + 1, 0);
  for (const auto c : matrix.column) ++result.begin[c + 1];
  for (std::size_t c = 0; c < n_columns; ++c) result.begin[c + 1] += result.begin[c];
  result.column.resize(matrix.column.size());
  result.weight.resize(matrix.column.size());
  auto next = result.begin;
  for (std::size_t r = 0; r + 1 < matrix.begin.size(); ++r)
    for (auto k = matrix.begin[r]; k < matrix.begin[r + 1]; ++k) {
      const auto at = next[matrix.column[k]]++;
      result.column[at] = static_cast<std::int32_t>(r);
      result.weight[at] = matrix.weight[k];
    }
  return result;
}

/// Gradients of the corners' hat functions at a Gauss point, in the reference cell (3 x 8).
std::vector<Eigen::Matrix<double, 3, 8>> hat_gradients(const Tabulation& at) {
  std::vector<Eigen::Matrix<double, 3, 8>> result(at.n_points);
  for (int q = 0; q < at.n_points; ++q)
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        double g = 1;
        for (int d = 0; d < 3; ++d) {
          const bool high = ((c >> d) & 1) == 1;
          g *= d == axis ? (high ? 1 : -1) : (high ? at.point[q][d] : 1 - at.point[q][d]);
        }
        result[q](axis, c) = g;
      }
  return result;
}

/// P'K P.
SymmetricMatrix assemble(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                         const PerCell<Lame>& elastic, const Grid& coarse, const CellsOfNodes& cells,
                         const NodeGraph& graph) {
  const Tabulation at = gauss_in_cell(grid.shape(), grid.degree + 1);
  const auto hats = hat_gradients(at);
  std::vector<std::size_t> place(grid.n_cells());
  for (std::size_t k = 0; k < order.cell.size(); ++k) place[order.cell[k]] = k;
  SymmetricMatrix matrix = make_matrix(graph);
  for (const auto& colour : colour_cells(coarse, cells))
    parallel_for(colour.size(), 16, [&](std::size_t begin, std::size_t end) {
      Eigen::MatrixXd scaled(24, at.n_points), products;
      for (std::size_t c = begin; c < end; ++c) {
        const double* m = &metric[place[colour[c]] * at.n_points * 9];
        for (int q = 0; q < at.n_points; ++q) {
          const Eigen::Map<const Eigen::Matrix3d> to_space(m + 9 * q);  // row-major there: transposed here
          Eigen::Map<Eigen::Matrix<double, 3, 8>>(scaled.col(q).data()).noalias() =
              to_space.lazyProduct(hats[q]);
        }
        add_cell_stiffness(scaled, coarse.nodes_of(colour[c]), elastic[colour[c]], graph, products, matrix);
      }
    });
  return matrix;
}

}  // namespace

CoarseSpace::CoarseSpace(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                         const PerCell<Lame>& elastic, CoarseLevel level, const kernel::Kernels& kernels) {
  std::vector<std::int32_t> coarse_of_place;
  const Grid coarse = corner_grid(grid, order, coarse_of_place);
  n_nodes_ = coarse.n_nodes;
  place_.resize(n_nodes_);
  std::iota(place_.begin(), place_.end(), 0);
  const auto cells = cells_of_nodes(coarse);
  const NodeGraph graph = make_node_graph(coarse, cells);
  interpolation_ = make_interpolation(grid, order, coarse);
  restriction_ = transpose(interpolation_, n_nodes_);
  if (level == CoarseLevel::aggregated) {
    multigrid_ = std::make_unique<AggregationMultigrid>(
        graph, assemble(grid, order, metric, elastic, coarse, cells, graph), coarse.xyz_m, kernels);
  } else {
    auto node_order = std::async(std::launch::async, order_nodes, std::cref(graph));
    auto matrix = assemble(grid, order, metric, elastic, coarse, cells, graph);
    supports_ = std::make_unique<Supports>(choose_supports(coarse), matrix);
    factor_ = std::make_unique<CholmodFactor>(matrix, node_order.get());
    factor_->factorise(matrix);
    without_rigid_ = WithoutModes(rigid_modes(coarse, Eigen::Vector3d::Zero()));
  }
}

std::size_t CoarseSpace::bytes() const {
  const auto of = [](const NodeMatrix& m) { return 8 * (m.begin.size() + m.column.size()); };
  return of(interpolation_) + of(restriction_) +
         (multigrid_ ? multigrid_->bytes() : static_cast<std::size_t>(1e9 * factor_->gigabytes()));
}

CoarseSpace::WorkSpace CoarseSpace::work_space(const Lanes& lanes) const {
  if (multigrid_) return {multigrid_->work_space(lanes)};
  return {};
}

void CoarseSpace::solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                        WorkSpace& work) const {
  if (multigrid_) return multigrid_->apply(lanes, b, x, work.multigrid);
  Eigen::MatrixXd columns(3 * n_nodes_, lanes.n_loads);
  from_block(b, lanes, place_, 0, columns);
  without_rigid_.apply(columns);
  supports_->clear(columns);
  columns = factor_->solve(columns);
  without_rigid_.apply(columns);
  to_block(columns, 0, place_, lanes, x);
}

}  // namespace fem
