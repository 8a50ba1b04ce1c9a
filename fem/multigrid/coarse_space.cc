#include "fem/multigrid/coarse_space.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fem/common/parallel.h"
#include "fem/mesh/cell_geometry.h"
#include "fem/mesh/hanging_nodes.h"

namespace fem {

namespace {

using Weights = std::map<std::int32_t, double>;  // by corner

/// Corners of cells in the middle of a larger cell's edge or face: nodes of its quadratic displacement, but
/// in its trilinear one they hang on its corners, which may hang on those of a still larger one.
HangingNodes hanging_corners(const Grid& grid, const Grid& coarse,
                             const std::vector<std::int32_t>& coarse_of_node) {
  HangingNodes hanging;
  if (grid.hanging.n() == 0) return hanging;
  const Tabulation nodes = nodes_in_cell(grid.shape());
  const auto corners = corner_nodes(grid.shape());
  std::map<std::int32_t, Weights> direct;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) {
      const auto corner = coarse_of_node[std::size_t(grid.nodes_of(c)[i])];
      if (corner < 0 || std::find(corners.begin(), corners.end(), i) != corners.end()) continue;
      const auto hats = corner_hats(grid.shape(), nodes.point[std::size_t(i)]);
      Weights& own = direct[corner];
      own.clear();  // every larger cell beside it says the same
      for (int k = 0; k < 8; ++k)
        if (hats[k] > 1e-12) own[coarse.nodes_of(c)[k]] = hats[k];
    }
  const std::function<void(std::int32_t, double, Weights&)> resolve = [&](std::int32_t corner, double weight,
                                                                          Weights& sum) {
    const auto found = direct.find(corner);
    if (found == direct.end())
      sum[corner] += weight;
    else
      for (const auto& [master, own] : found->second) resolve(master, weight * own, sum);
  };
  for (const auto& known : direct) {
    Weights masters;
    resolve(known.first, 1, masters);
    hanging.add(known.first, masters);
  }
  return hanging;
}

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
  std::vector<std::int32_t> coarse_of_node(grid.n_nodes);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) coarse_of_node[i] = coarse_of_place[order.node_place[i]];
  coarse.hanging = hanging_corners(grid, coarse, coarse_of_node);
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
  const auto& hanging = coarse.hanging;
  std::vector<std::int32_t> hangs(coarse.n_nodes, -1);
  for (std::size_t i = 0; i < hanging.n(); ++i) hangs[std::size_t(hanging.node[i])] = std::int32_t(i);
  NodeMatrix matrix;
  matrix.height = matrix.width = 1;
  matrix.n_columns = coarse.n_nodes;
  matrix.begin.push_back(0);
  for (const auto& [cell, local] : row) {
    const auto hats = corner_hats(grid.shape(), nodes.point[local]);
    Weights weights;
    for (int k = 0; k < 8; ++k) {
      if (!(hats[k] > 1e-12)) continue;
      const auto corner = coarse.nodes_of(cell)[k];
      if (const auto h = hangs[std::size_t(corner)]; h < 0)
        weights[corner] += hats[k];
      else
        for (auto m = hanging.begin[std::size_t(h)]; m < hanging.begin[std::size_t(h) + 1]; ++m)
          weights[hanging.master[m]] += hats[k] * hanging.weight[m];
    }
    for (const auto& [corner, weight] : weights) {
      matrix.column.push_back(corner);
      matrix.block.push_back(static_cast<float>(weight));
    }
    matrix.begin.push_back(static_cast<std::int64_t>(matrix.column.size()));
  }
  return matrix;
}

NodeMatrix first_rows(NodeMatrix matrix, std::size_t n) {
  matrix.begin.resize(n + 1);
  matrix.column.resize(std::size_t(matrix.begin.back()));
  matrix.block.resize(std::size_t(matrix.begin.back()));
  return matrix;
}

/// The mesh of corners without the cells of other ranks, which these bring themselves.
Grid cells_with_stiffness(Grid coarse, const PerCell<Lame>& elastic) {
  std::vector<std::int32_t> nodes;
  std::vector<int> volume_id;
  for (std::size_t c = 0; c < coarse.n_cells(); ++c) {
    if (!has_stiffness(elastic[std::int32_t(c)])) continue;
    nodes.insert(nodes.end(), coarse.nodes_of(c), coarse.nodes_of(c) + 8);
    volume_id.push_back(coarse.volume_id[c]);
  }
  coarse.cell_nodes = std::move(nodes);
  coarse.volume_id = std::move(volume_id);
  return coarse;
}

/// P'K P.
SymmetricMatrix assemble(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                         const PerCell<Lame>& elastic, const Grid& coarse, const CellsOfNodes& cells,
                         const NodeGraph& graph) {
  const Tabulation at = gauss_in_cell(grid.shape(), grid.degree + 1);
  const Tabulation hats = gauss_in_cell({grid.kind, 1}, grid.degree + 1);
  std::vector<std::size_t> place(grid.n_cells());
  for (std::size_t k = 0; k < order.cell.size(); ++k) place[order.cell[k]] = k;
  const CellCouplings couplings(coarse);
  SymmetricMatrix matrix = make_matrix(graph);
  for (const auto& colour : colour_cells(coarse, cells))
    parallel_for(colour.size(), 16, [&](std::size_t begin, std::size_t end) {
      Eigen::MatrixXd scaled, products;
      for (std::size_t c = begin; c < end; ++c) {
        scaled.resize(24, at.n_points);
        const double* m = &metric[place[colour[c]] * at.n_points * 9];
        for (int q = 0; q < at.n_points; ++q) {
          const Eigen::Map<const Eigen::Matrix3d> to_space(m + 9 * q);  // row-major there: transposed here
          const Eigen::Map<const Eigen::Matrix<double, 3, 8>> slopes(
              hats.gradient[8 * std::size_t(q)].data());
          Eigen::Map<Eigen::Matrix<double, 3, 8>>(scaled.col(q).data()).noalias() =
              to_space.lazyProduct(slopes);
        }
        couplings.couple(std::size_t(colour[c]), 3, scaled);
        add_cell_stiffness(scaled, couplings.nodes(std::size_t(colour[c])), elastic[colour[c]], graph,
                           products, matrix);
      }
    });
  hold_hanging(coarse.hanging, graph, matrix);
  return matrix;
}

}  // namespace

CoarseSpace::CoarseSpace(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                         const PerCell<Lame>& elastic, CoarseLevel level, const kernel::Kernels& kernels,
                         const SharedNodes* shared) {
  std::vector<std::int32_t> coarse_of_place;
  const Grid coarse = corner_grid(grid, order, coarse_of_place);
  n_nodes_ = coarse.n_nodes;
  const auto cells = cells_of_nodes(coarse);
  const NodeGraph graph = make_node_graph(coarse, cells);
  interpolation_ = make_interpolation(grid, order, coarse);
  restriction_ =
      transpose(shared == nullptr ? interpolation_ : first_rows(interpolation_, shared->n_counted()));
  const auto stiffness = [&] { return assemble(grid, order, metric, elastic, coarse, cells, graph); };
  if (shared == nullptr) {
    solver_ = std::make_unique<CoarseSolver>(coarse, graph, stiffness, level, kernels);
    return;
  }
  std::vector<std::int32_t> corner;
  for (std::size_t place = 0; place < grid.n_nodes; ++place)
    if (coarse_of_place[place] >= 0) corner.push_back(shared->body_node()[place]);
  on_last_rank_ = std::make_unique<CoarseOnLastRank>(
      shared->communicator(), cells_with_stiffness(coarse, elastic), corner, stiffness(), level, kernels);
}

std::size_t CoarseSpace::bytes() const {
  return interpolation_.bytes() + restriction_.bytes() +
         (solver_ ? solver_->bytes() : on_last_rank_->bytes());
}

CoarseSpace::WorkSpace CoarseSpace::work_space(const Lanes& lanes) const {
  if (solver_) return {solver_->work_space(lanes), {}};
  return {{}, on_last_rank_->work_space(lanes)};
}

void CoarseSpace::solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                        WorkSpace& work) const {
  if (solver_)
    solver_->solve(lanes, b, x, work.alone);
  else
    on_last_rank_->solve(lanes, b, x, work.on_last_rank);
}

}  // namespace fem
