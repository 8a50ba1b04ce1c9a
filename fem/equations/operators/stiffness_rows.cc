#include "fem/equations/operators/stiffness_rows.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "fem/base/values/errors.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/hanging_nodes.h"

namespace fem {

RowPlan::RowPlan(const Grid& grid, std::vector<int> ranks, int of_rank, int number_of_ranks)
    : rank(of_rank), n_ranks(number_of_ranks), rank_of_node(std::move(ranks)), row(grid.n_nodes, -1) {
  std::vector<char> hangs(grid.n_nodes, 0);
  for (const auto node : grid.hanging.node) hangs[std::size_t(node)] = 1;
  std::int32_t next = 0;
  for (int r = 0; r < n_ranks; ++r) {
    if (r == rank) first = next;
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      if (rank_of_node[i] == r && hangs[i] == 0) {
        row[i] = next++;
        if (r == rank) own.push_back(std::int32_t(i));
      }
  }
}

namespace {

/// A mesh with its nodes in the order of the plan's rows; nodes that hang come last.
struct OrderedMesh {
  const Grid& grid;
  std::vector<std::int32_t> order;  ///< node at each place
  std::vector<std::int32_t> row;    ///< at each place, ascending, without those that hang
  std::vector<std::int32_t> node;   ///< of the body, at each place
};

/// @param node  number in the body of each node; null: the body itself
OrderedMesh in_order(const Grid& grid, const std::vector<std::int32_t>* node, const RowPlan& plan) {
  OrderedMesh mesh{grid, std::vector<std::int32_t>(grid.n_nodes), {}, {}};
  const auto of_body = [&](std::int32_t i) { return node == nullptr ? i : (*node)[std::size_t(i)]; };
  const auto key = [&](std::int32_t i) {
    const auto row = plan.row[std::size_t(of_body(i))];
    return row < 0 ? std::numeric_limits<std::int32_t>::max() : row;
  };
  std::iota(mesh.order.begin(), mesh.order.end(), 0);
  std::stable_sort(mesh.order.begin(), mesh.order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  for (const auto i : mesh.order) {
    mesh.node.push_back(of_body(i));
    if (const auto row = plan.row[std::size_t(of_body(i))]; row >= 0) mesh.row.push_back(row);
  }
  return mesh;
}

/// From a matrix of the mesh in order to this rank's rows.
class RowFiller {
public:
  RowFiller(const OrderedMesh& mesh, const RowPlan& plan, const std::vector<std::int64_t>& held)
      : mesh_(mesh), plan_(plan), held_(3 * mesh.order.size(), 0) {
    for (std::size_t p = 0; p < mesh.node.size(); ++p)
      for (int d = 0; d < 3; ++d)
        if (std::binary_search(held.begin(), held.end(), 3 * std::int64_t(mesh.node[p]) + d))
          held_[3 * p + std::size_t(d)] = 1;
  }

  CompressedRows fill(const NodeGraph& graph, const SymmetricMatrix& matrix) const {
    const std::size_t n = mesh_.row.size();
    std::vector<std::size_t> begin(plan_.own.size() + 1, 0);  // blocks of each own node
    const auto count = [&](std::size_t p) {
      if (is_own(p)) ++begin[own(p) + 1];
    };
    for (std::size_t p = 0; p < n; ++p) {
      count(p);
      for (auto k = graph.begin[p]; k < graph.begin[p + 1]; ++k) {
        const auto q = std::size_t(graph.neighbour[std::size_t(k)]);
        if (q >= n) continue;
        if (is_own(p)) ++begin[own(p) + 1];
        count(q);
      }
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    refuse_many(9 * begin.back());
    CompressedRows rows;
    rows.column.resize(9 * begin.back());
    rows.value.resize(9 * begin.back());
    for (std::size_t i = 0; i < plan_.own.size(); ++i)
      for (std::size_t d = 1; d <= 3; ++d)
        rows.begin.push_back(std::int32_t(9 * begin[i] + 3 * d * (begin[i + 1] - begin[i])));
    std::vector<std::size_t> next(plan_.own.size(), 0);
    const auto put = [&](std::size_t p, std::size_t q, const Eigen::Matrix3d& block) {
      if (!is_own(p)) return;
      const auto at = 3 * next[own(p)]++;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
          const auto k = std::size_t(rows.begin[3 * own(p) + a]) + at + b;
          const bool is_cut = (held_[3 * p + a] != 0 || held_[3 * q + b] != 0) && (p != q || a != b);
          rows.column[k] = 3 * mesh_.row[q] + std::int32_t(b);
          rows.value[k] = is_cut ? 0 : block(Eigen::Index(a), Eigen::Index(b));
        }
    };
    for (std::size_t p = 0; p < n; ++p)
      for_blocks_of(matrix, p, [&](std::int32_t q, const Eigen::Matrix3d& block) {
        if (std::size_t(q) >= n) return;
        put(std::size_t(q), p, block);
        if (std::size_t(q) != p) put(p, std::size_t(q), block.transpose());
      });
    return rows;
  }

private:
  bool is_own(std::size_t place) const { return plan_.is_own(mesh_.row[place]); }
  std::size_t own(std::size_t place) const { return std::size_t(mesh_.row[place] - plan_.first); }
  static void refuse_many(std::size_t n_entries) {
    if (n_entries > std::size_t(std::numeric_limits<std::int32_t>::max()))
      throw DoesNotFit("the stiffness has " + std::to_string(n_entries) +
                       " entries on one rank, PETSc counts 2147483647 at most: use more MPI ranks or larger "
                       "cells");
  }

  const OrderedMesh& mesh_;
  const RowPlan& plan_;
  std::vector<char> held_;  // by unknown in the order of the mesh
};

CompressedRows rows_of(const OrderedMesh& mesh, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                       const RowPlan& plan, const std::vector<std::int64_t>& held) {
  const NodeGraph graph = permuted(make_node_graph(mesh.grid, cells), mesh.order);
  SymmetricMatrix matrix = make_matrix(graph);
  assemble_stiffness(mesh.grid, colour_cells(mesh.grid, cells), graph, elastic, matrix,
                     places_in(mesh.order));
  return RowFiller(mesh, plan, held).fill(graph, matrix);
}

}  // namespace

CompressedRows stiffness_rows(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                              const RowPlan& plan, const std::vector<std::int64_t>& held) {
  if (plan.n_ranks == 1) return rows_of(in_order(grid, nullptr, plan), cells, elastic, plan, held);
  const CellCouplings couplings(grid);
  std::vector<int> is_wanted(grid.n_cells(), 0);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < couplings.n_nodes(c); ++i)
      if (plan.rank_of_node[std::size_t(couplings.nodes(c)[i])] == plan.rank) is_wanted[c] = 1;
  const auto share = share_of_rank(grid, cells, is_wanted, 1, elastic);
  const auto& part = share.part;
  return rows_of(in_order(part.grid, &part.node, plan), cells_of_nodes(part.grid),
                 cell_after_cell(share.elastic), plan, held);
}

}  // namespace fem
