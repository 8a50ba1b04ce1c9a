#include "fem/mesh/grid/linear_level.h"

#include <Eigen/Core>
#include <map>
#include <utility>

#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

using Parents = std::vector<std::pair<std::int32_t, double>>;

/// What each node depends on: nothing for a vertex.
std::vector<Parents> parents_of_nodes(const Grid& grid) {
  const auto corners = corner_nodes(grid.shape());
  const auto& local = nodes_in_cell(grid.shape());
  std::vector<std::vector<double>> hats;
  for (const auto& point : local.point) hats.push_back(corner_hats(grid.shape(), point));
  std::vector<Parents> parents(grid.n_nodes);
  std::vector<double> size(grid.n_nodes, 0);
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    const auto* nodes = grid.nodes_of(c);
    const Eigen::Map<const Eigen::Vector3d> begin(grid.position(nodes[corners.front()])),
        end(grid.position(nodes[corners.back()]));
    const double diagonal = (end - begin).squaredNorm();
    for (std::size_t i = 0; i < hats.size(); ++i) {
      Parents found;
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (hats[i][k] > 1e-12) found.emplace_back(nodes[corners[k]], hats[i][k]);
      const auto node = std::size_t(nodes[i]);
      if (found.size() == 1 || diagonal <= size[node]) continue;
      size[node] = diagonal;
      parents[node] = std::move(found);
    }
  }
  const auto& hanging = grid.hanging;
  for (std::size_t h = 0; h < hanging.n(); ++h) {
    auto& masters = parents[std::size_t(hanging.node[h])];
    masters.clear();
    for (auto k = hanging.begin[h]; k < hanging.begin[h + 1]; ++k)
      masters.emplace_back(hanging.master[k], hanging.weight[k]);
  }
  return parents;
}

}  // namespace

LinearLevel make_linear_level(const Grid& grid) {
  const auto parents = parents_of_nodes(grid);
  std::vector<char> hangs(grid.n_nodes, 0);
  for (const auto node : grid.hanging.node) hangs[std::size_t(node)] = 1;
  LinearLevel level;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    std::map<std::int32_t, double> sums;
    Parents open;
    if (hangs[i] == 0) open.emplace_back(std::int32_t(i), 1.0);
    while (!open.empty()) {
      const auto [node, weight] = open.back();
      open.pop_back();
      if (parents[std::size_t(node)].empty()) sums[node] += weight;
      for (const auto& [parent, share] : parents[std::size_t(node)])
        open.emplace_back(parent, weight * share);
    }
    for (const auto& [vertex, weight] : sums) {
      level.vertex.push_back(vertex);
      level.weight.push_back(weight);
    }
    level.begin.push_back(level.vertex.size());
  }
  return level;
}

}  // namespace fem
