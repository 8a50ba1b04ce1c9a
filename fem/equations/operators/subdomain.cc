#include "fem/equations/operators/subdomain.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "fem/base/values/cell_shares.h"
#include "fem/base/values/vtk_order.h"
#include "fem/mesh/ranks/deal_out_cells.h"
#include "fem/mesh/ranks/ranks.h"

namespace fem {

Subdomain make_subdomain(const Grid& grid, const std::vector<std::int32_t>& cells) {
  Subdomain result;
  result.cell = cells;
  result.grid.kind = grid.kind;
  result.grid.degree = grid.degree;
  std::vector<std::int32_t> number(grid.n_nodes, -1), place(grid.n_cells(), -1);
  result.node = nodes_of_cells(grid, cells);
  for (std::size_t i = 0; i < result.node.size(); ++i) {
    number[result.node[i]] = static_cast<std::int32_t>(i);
    const double* at = grid.position(result.node[i]);
    result.grid.xyz_m.insert(result.grid.xyz_m.end(), at, at + 3);
  }
  result.grid.n_nodes = result.node.size();
  for (const auto c : cells) {
    place[c] = static_cast<std::int32_t>(result.grid.volume_id.size());
    result.grid.volume_id.push_back(grid.volume_id[c]);
    for (int i = 0; i < grid.nodes_per_cell(); ++i)
      result.grid.cell_nodes.push_back(number[grid.nodes_of(c)[i]]);
  }
  for (auto face : grid.boundary) {
    face.cell = place[face.cell];
    if (face.cell >= 0) result.grid.boundary.push_back(face);
  }
  const auto& hanging = grid.hanging;
  for (std::size_t i = 0; i < hanging.n(); ++i) {
    const auto node = number[hanging.node[i]];
    if (node < 0) continue;
    std::vector<std::pair<std::int32_t, double>> masters;
    for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k) {
      if (number[hanging.master[k]] < 0)
        throw std::logic_error("a part of a mesh without the cells that its hanging nodes hang on");
      masters.emplace_back(number[hanging.master[k]], hanging.weight[k]);
    }
    result.grid.hanging.add(node, masters);
  }
  return result;
}

Subdomain make_subdomain(const Nodes& nodes, const std::vector<std::int32_t>& cells) {
  const std::size_t n_local = nodes.nodes_per_cell();
  Subdomain result;
  result.cell = cells;
  result.node.reserve(cells.size() * n_local);
  for (const auto c : cells)
    result.node.insert(result.node.end(), nodes.cell(std::size_t(c)).begin(),
                       nodes.cell(std::size_t(c)).end());
  std::sort(result.node.begin(), result.node.end());
  result.node.erase(std::unique(result.node.begin(), result.node.end()), result.node.end());
  auto& grid = result.grid;
  grid.kind = nodes.kind;
  grid.degree = nodes.degree;
  grid.n_nodes = result.node.size();
  for (const auto node : result.node)
    grid.xyz_m.insert(grid.xyz_m.end(), &nodes.xyz_m[3 * std::size_t(node)],
                      &nodes.xyz_m[3 * std::size_t(node)] + 3);
  grid.cell_nodes.resize(cells.size() * n_local);
  const int* order = vtk_hexahedron_order(nodes.degree);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t v = 0; v < n_local; ++v) {
      const auto node = nodes.cell(std::size_t(cells[c]))[v];
      grid.cell_nodes[c * n_local + (nodes.shape().is_tetrahedron() ? v : std::size_t(order[v]))] =
          std::int32_t(std::lower_bound(result.node.begin(), result.node.end(), node) - result.node.begin());
    }
  for (const auto c : cells)
    grid.volume_id.push_back(nodes.cell_volume_id.empty() ? 0 : nodes.cell_volume_id[std::size_t(c)]);
  return result;
}

Subdomain make_subdomain(const Nodes& nodes) {
  std::vector<std::int32_t> all(nodes.n_cells());
  std::iota(all.begin(), all.end(), 0);
  return make_subdomain(nodes, all);
}

std::vector<int> shares_of_cells(const Nodes& nodes, int n_shares) {
  return deal_out_cells(make_subdomain(nodes).grid, n_shares);
}

std::shared_ptr<SharedRows> share_rows(MPI_Comm communicator, const Nodes& nodes) {
  const int n = n_ranks(communicator);
  if (n == 1) return nullptr;
  return share_rows(communicator, make_subdomain(nodes).grid, shares_of_cells(nodes, n));
}

std::vector<int> ranks_of_nodes(const Grid& grid, const std::vector<int>& rank_of_cell) {
  std::vector<int> rank(grid.n_nodes, -1);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) {
      auto& own = rank[grid.nodes_of(c)[i]];
      own = own < 0 ? rank_of_cell[c] : std::min(own, rank_of_cell[c]);
    }
  return rank;
}

std::size_t n_unknowns_of_rank(const Grid& grid, const std::vector<int>& rank_of_node, int rank) {
  const auto& hanging = grid.hanging.node;
  const auto n_counted = std::count(rank_of_node.begin(), rank_of_node.end(), rank);
  const auto n_hanging = std::count_if(hanging.begin(), hanging.end(),
                                       [&](std::int32_t node) { return rank_of_node[node] == rank; });
  return 3 * static_cast<std::size_t>(n_counted - n_hanging);
}

std::vector<std::int32_t> cells_of_rank(const std::vector<int>& rank_of_cell, int rank) {
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < rank_of_cell.size(); ++c)
    if (rank_of_cell[c] == rank) cells.push_back(static_cast<std::int32_t>(c));
  return cells;
}

std::vector<std::int32_t> with_layers(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                                      const std::vector<std::int32_t>& cells, int n_layers) {
  std::vector<char> taken(grid.n_cells(), 0);
  for (const auto c : cells) taken[c] = 1;
  std::vector<std::int32_t> front = cells, all = cells;
  for (int layer = 0; layer < n_layers; ++layer) {
    std::vector<std::int32_t> next;
    for (const auto c : front)
      for (int i = 0; i < grid.nodes_per_cell(); ++i) {
        const auto node = grid.nodes_of(c)[i];
        for (auto k = cells_of_nodes.begin[node]; k < cells_of_nodes.begin[node + 1]; ++k)
          if (const auto other = cells_of_nodes.cell[k]; !taken[other]) {
            taken[other] = 1;
            next.push_back(other);
          }
      }
    all.insert(all.end(), next.begin(), next.end());
    front = std::move(next);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::int32_t> with_cells_hung_on(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                                             const std::vector<std::int32_t>& cells) {
  const auto& hanging = grid.hanging;
  if (hanging.n() == 0) return cells;
  std::vector<std::int32_t> hangs(grid.n_nodes, -1);
  for (std::size_t i = 0; i < hanging.n(); ++i) hangs[hanging.node[i]] = static_cast<std::int32_t>(i);
  const auto corners = corner_nodes(grid.shape());
  const auto is_corner_of = [&](std::int32_t cell, std::int32_t node) {
    const auto* nodes = grid.nodes_of(cell);
    return std::any_of(corners.begin(), corners.end(), [&](int i) { return nodes[i] == node; });
  };
  std::vector<char> taken(grid.n_cells(), 0), is_there(grid.n_nodes, 0);
  std::vector<std::int32_t> all, masters;
  const auto take = [&](std::int32_t cell) {
    if (taken[cell] != 0) return;
    taken[cell] = 1;
    all.push_back(cell);
  };
  for (const auto cell : cells) take(cell);
  std::size_t next = 0;
  while (next < all.size()) {
    for (; next < all.size(); ++next) {
      const auto cell = all[next];
      for (int i = 0; i < grid.nodes_per_cell(); ++i) {
        const auto node = grid.nodes_of(cell)[i];
        is_there[node] = 1;
        if (const auto h = hangs[node]; h >= 0)
          masters.insert(masters.end(), hanging.master.begin() + std::ptrdiff_t(hanging.begin[h]),
                         hanging.master.begin() + std::ptrdiff_t(hanging.begin[h + 1]));
      }
      for (const int i : corners) {  // some lie in the middle of a larger cell's edge or face
        const auto node = grid.nodes_of(cell)[i];
        for (auto k = cells_of_nodes.begin[node]; k < cells_of_nodes.begin[node + 1]; ++k)
          if (!is_corner_of(cells_of_nodes.cell[k], node)) take(cells_of_nodes.cell[k]);
      }
    }
    for (const auto master : masters)
      if (is_there[master] == 0) take(cells_of_nodes.cell[cells_of_nodes.begin[master]]);
    masters.clear();
  }
  std::sort(all.begin(), all.end());
  return all;
}

StiffnessShare share_of_rank(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                             const std::vector<int>& rank_of_cell, int rank, const PerCell<Lame>& elastic) {
  StiffnessShare share;
  share.part =
      make_subdomain(grid, with_cells_hung_on(grid, cells_of_nodes, cells_of_rank(rank_of_cell, rank)));
  for (const auto c : share.part.cell)
    share.elastic.push_back(rank_of_cell[c] == rank ? elastic[c] : Lame{0, 0});
  return share;
}

std::size_t StiffnessShare::n_own_cells() const {
  return std::size_t(std::count_if(elastic.begin(), elastic.end(), has_stiffness));
}

std::vector<std::int32_t> nodes_of_cells(const Grid& grid, const std::vector<std::int32_t>& cells) {
  std::vector<char> is_there(grid.n_nodes, 0);
  for (const auto c : cells)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) is_there[grid.nodes_of(c)[i]] = 1;
  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < grid.n_nodes; ++node)
    if (is_there[node] != 0) nodes.push_back(static_cast<std::int32_t>(node));
  return nodes;
}

std::shared_ptr<SharedRows> share_rows(MPI_Comm communicator, const Grid& grid,
                                       const std::vector<int>& rank_of_cell) {
  auto shared = std::make_shared<SharedRows>();
  shared->communicator = communicator;
  shared->rank_of_cell = rank_of_cell;
  shared->rank_of_node = ranks_of_nodes(grid, rank_of_cell);
  shared->row.assign(grid.n_nodes, -1);
  shared->is_everywhere.assign(grid.n_nodes, 0);
  const int rank = this_rank(communicator);
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    if (shared->rank_of_node[i] == rank) {
      shared->row[i] = std::int32_t(shared->node.size());
      shared->node.push_back(std::int32_t(i));
    }
  return shared;
}

RankPart::RankPart(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic, int of_rank,
                   int n_ranks, double cells_of_first)
    : rank(of_rank),
      rank_of_cell(deal_out_cells(grid, n_ranks, cells_of_first)),
      rank_of_node(ranks_of_nodes(grid, rank_of_cell)),
      share(share_of_rank(grid, cells, rank_of_cell, rank, elastic)),
      n_unknowns(n_unknowns_of_rank(grid, rank_of_node, rank)) {
  for (const auto node : share.part.node) counted.push_back(rank_of_node[std::size_t(node)] == rank ? 1 : 0);
}

std::vector<Lame> elastic_of(const Subdomain& subdomain, const PerCell<Lame>& elastic) {
  std::vector<Lame> values;
  for (const auto c : subdomain.cell) values.push_back(elastic[c]);
  return values;
}

PerCell<Lame> cell_after_cell(std::vector<Lame> elastic) {
  auto which = std::make_shared<std::vector<std::int32_t>>(elastic.size());
  std::iota(which->begin(), which->end(), 0);
  return {std::move(elastic), std::move(which)};
}

}  // namespace fem
