#include "fem/operators/hanging_in_blocks.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fem/common/parallel.h"

namespace fem {

namespace {

constexpr std::size_t rows_at_once = 256;

/// Calls handle(numbers of a node, values) for each group of lanes.
template <typename T, typename Handle>
void for_each_group(const Lanes& lanes, BlockVector<T>& vector, const Handle& handle) {
  for (const auto& group : lanes.groups)
    handle(3 * std::size_t(group.width), vector.data() + 3 * vector.n_nodes() * group.first_lane);
}

}  // namespace

HangingInBlocks::HangingInBlocks(const HangingNodes& hanging, const std::vector<std::int32_t>& place) {
  std::map<std::int32_t, std::vector<std::pair<std::int32_t, double>>> by_master;
  for (std::size_t i = 0; i < hanging.n(); ++i) {
    const auto node = place[std::size_t(hanging.node[i])];
    of_masters_.row.push_back(node);
    for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k) {
      const auto master = place[std::size_t(hanging.master[k])];
      of_masters_.column.push_back(master);
      of_masters_.weight.push_back(hanging.weight[k]);
      by_master[master].emplace_back(node, hanging.weight[k]);
    }
    of_masters_.begin.push_back(of_masters_.column.size());
  }
  for (const auto& [master, nodes] : by_master) {
    of_hanging_.row.push_back(master);
    for (const auto& [node, weight] : nodes) {
      of_hanging_.column.push_back(node);
      of_hanging_.weight.push_back(weight);
    }
    of_hanging_.begin.push_back(of_hanging_.column.size());
  }
}

template <typename T>
void HangingInBlocks::add(const Rows& rows, std::size_t n, T* values) {
  parallel_for(rows.row.size(), rows_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      T* const to = values + std::size_t(rows.row[i]) * n;
      for (auto k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
        const T* const from = values + std::size_t(rows.column[k]) * n;
        const T weight = T(rows.weight[k]);
        for (std::size_t l = 0; l < n; ++l) to[l] += weight * from[l];
      }
    }
  });
}

template <typename T>
void HangingInBlocks::clear_hanging(std::size_t n, T* values) const {
  for (const auto node : of_masters_.row) std::fill_n(values + std::size_t(node) * n, n, T(0));
}

template <typename T>
void HangingInBlocks::set(const Lanes& lanes, BlockVector<T>& vector) const {
  for_each_group(lanes, vector, [&](std::size_t n, T* values) {
    clear_hanging(n, values);
    add(of_masters_, n, values);
  });
}

template <typename T>
void HangingInBlocks::move_to_masters(const Lanes& lanes, BlockVector<T>& vector) const {
  for_each_group(lanes, vector, [&](std::size_t n, T* values) {
    add(of_hanging_, n, values);
    clear_hanging(n, values);
  });
}

template void HangingInBlocks::set(const Lanes&, BlockVector<double>&) const;
template void HangingInBlocks::set(const Lanes&, BlockVector<float>&) const;
template void HangingInBlocks::move_to_masters(const Lanes&, BlockVector<double>&) const;
template void HangingInBlocks::move_to_masters(const Lanes&, BlockVector<float>&) const;

}  // namespace fem
