#include "fem/mesh/ranks/deal_out_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

/// @param weight  of each share
/// @param share   of each cell: `first` to last - 1 are given to these cells
void deal_out(const Centres& centre, const std::vector<double>& weight, std::int32_t* begin,
              std::int32_t* end, int first, int last, std::vector<int>& share) {
  if (last - first == 1) {
    for (const auto* cell = begin; cell != end; ++cell) share[std::size_t(*cell)] = first;
    return;
  }
  const int between = (first + last) / 2;
  const auto sum = [&](int from, int to) { return std::accumulate(&weight[from], &weight[0] + to, 0.0); };
  auto* middle = begin + std::lround(sum(first, between) / sum(first, last) * double(end - begin));
  if (middle != end) split(centre, begin, middle, end);
  deal_out(centre, weight, begin, middle, first, between, share);
  deal_out(centre, weight, middle, end, between, last, share);
}

Centres corner_sums(const Grid& grid) {
  Centres sum(grid.n_cells(), {0, 0, 0});
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corner_nodes(grid.shape()))
      for (int d = 0; d < 3; ++d) sum[c][d] += grid.position(grid.nodes_of(c)[i])[d];
  return sum;
}

}  // namespace

std::vector<int> deal_out_cells(const Grid& grid, int n_shares, double first) {
  std::vector<std::int32_t> cell(grid.n_cells());
  std::iota(cell.begin(), cell.end(), 0);
  std::vector<int> share(cell.size(), 0);
  std::vector<double> weight(std::size_t(n_shares), 1.0);
  weight[0] = first;
  deal_out(corner_sums(grid), weight, cell.data(), cell.data() + cell.size(), 0, n_shares, share);
  return share;
}

}  // namespace fem
