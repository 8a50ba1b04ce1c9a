#include "fem/mesh/cell_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "fem/common/elastic_kernel.h"

namespace fem {

namespace {

using Centres = std::vector<std::array<double, 3>>;

/// Brings the cells of the lower part of the longest extent before `middle`.
void split(const Centres& centre, std::int32_t* begin, std::int32_t* middle, std::int32_t* end) {
  if (end - begin < 2) return;
  std::array<double, 3> low = centre[*begin], high = low;
  for (const auto* cell = begin; cell != end; ++cell)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], centre[*cell][d]);
      high[d] = std::max(high[d], centre[*cell][d]);
    }
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (high[d] - low[d] > high[axis] - low[axis]) axis = d;
  std::nth_element(begin, middle, end, [&](std::int32_t a, std::int32_t b) {
    return centre[a][axis] != centre[b][axis] ? centre[a][axis] < centre[b][axis] : a < b;
  });
}

void bisect(const Centres& centre, std::int32_t* begin, std::int32_t* end) {
  if (end - begin < 2) return;
  auto* middle = begin + (end - begin) / 2;
  split(centre, begin, middle, end);
  bisect(centre, begin, middle);
  bisect(centre, middle, end);
}

/// @param share  of each cell; those from `first` on are given to these
void deal_out(const Centres& centre, std::int32_t* begin, std::int32_t* end,
              const std::vector<double>& weights, std::size_t first, std::size_t last,
              std::vector<int>& share) {
  if (last - first == 1) {
    for (const auto* cell = begin; cell != end; ++cell) share[std::size_t(*cell)] = int(first);
    return;
  }
  const std::size_t between = (first + last) / 2;
  const auto sum = [&](std::size_t from, std::size_t to) {
    return std::accumulate(weights.begin() + std::ptrdiff_t(from), weights.begin() + std::ptrdiff_t(to), 0.0);
  };
  auto* middle = begin + std::lround(sum(first, between) / sum(first, last) * double(end - begin));
  if (middle != end) split(centre, begin, middle, end);
  deal_out(centre, begin, middle, weights, first, between, share);
  deal_out(centre, middle, end, weights, between, last, share);
}

Centres corner_sums(const Grid& grid) {
  Centres sum(grid.n_cells(), {0, 0, 0});
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corner_nodes(grid.shape()))
      for (int d = 0; d < 3; ++d) sum[c][d] += grid.position(grid.nodes_of(c)[i])[d];
  return sum;
}

constexpr std::size_t n_parts_at_most = 16, cells_per_part = 200;

}  // namespace

std::vector<int> deal_out_cells(const Grid& grid, const std::vector<double>& weights) {
  std::vector<std::int32_t> cell(grid.n_cells());
  std::iota(cell.begin(), cell.end(), 0);
  std::vector<int> share(cell.size(), 0);
  deal_out(corner_sums(grid), cell.data(), cell.data() + cell.size(), weights, 0, weights.size(), share);
  return share;
}

std::vector<double> even_weights(int n_shares) {
  return std::vector<double>(std::size_t(n_shares), 1.0);
}

CellOrder order_cells(const Grid& grid) {
  const std::size_t n_cells = grid.n_cells();
  const int n_local = grid.nodes_per_cell();
  CellOrder order;
  order.cell.resize(n_cells);
  std::iota(order.cell.begin(), order.cell.end(), 0);
  bisect(corner_sums(grid), order.cell.data(), order.cell.data() + n_cells);
  order.node_place.assign(grid.n_nodes, -1);
  std::int32_t next = 0;
  for (const auto c : order.cell)
    for (int i = 0; i < n_local; ++i) {
      auto& place = order.node_place[grid.nodes_of(c)[i]];
      if (place < 0) place = next++;
    }
  const std::size_t n_parts = std::clamp<std::size_t>(n_cells / cells_per_part, 1, n_parts_at_most);
  for (std::size_t p = 0; p <= n_parts; ++p) order.part_begin.push_back(p * n_cells / n_parts);
  return order;
}

AddTargets make_targets(const Grid& grid, const CellOrder& order) {
  const int n_local = grid.nodes_per_cell();
  AddTargets result;
  result.node.reserve(grid.cell_nodes.size());
  result.target.reserve(grid.cell_nodes.size());
  std::vector<std::int32_t> owner(grid.n_nodes, -1), last_part(grid.n_nodes, -1), copy(grid.n_nodes, -1);
  std::int32_t n_copies = 0;
  std::vector<std::array<std::int32_t, 2>> copies;
  for (std::size_t part = 0; part + 1 < order.part_begin.size(); ++part)
    for (std::size_t k = order.part_begin[part]; k < order.part_begin[part + 1]; ++k)
      for (int i = 0; i < n_local; ++i) {
        const auto node = order.node_place[grid.nodes_of(order.cell[k])[i]];
        const auto me = static_cast<std::int32_t>(part);
        const bool first = last_part[node] != me;
        last_part[node] = me;
        if (owner[node] < 0) owner[node] = me;
        const bool mine = owner[node] == me;
        if (!mine && first) {
          copy[node] = n_copies++;
          copies.push_back({node, copy[node]});
        }
        const auto place = mine ? node : copy[node];
        result.node.push_back(node);
        result.target.push_back((place << kernel::place_shift) | (first ? kernel::first_bit : 0) |
                                (mine ? 0 : kernel::copy_bit));
      }
  std::sort(copies.begin(), copies.end());
  for (const auto& [node, which] : copies) {
    result.copied.push_back(node);
    result.copy.push_back(which);
  }
  return result;
}

}  // namespace fem
