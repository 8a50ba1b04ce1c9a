#include "fem/operators/block_vector.h"

#include <algorithm>
#include <new>

#include "fem/common/parallel.h"

namespace fem {

namespace {
constexpr std::align_val_t cache_line{64};
}

template <typename T>
Lanes spread_over_lanes(std::size_t n_loads, const kernel::Kernels& kernels) {
  const int* widths = sizeof(T) == sizeof(double) ? kernels.widths_double : kernels.widths_float;
  const std::size_t large = widths[0], small = widths[1];
  Lanes lanes;
  lanes.n_loads = n_loads;
  while (lanes.n_lanes < n_loads) {
    const std::size_t width = small != 0 && n_loads - lanes.n_lanes <= small ? small : large;
    lanes.groups.push_back({lanes.n_lanes, static_cast<int>(width)});
    lanes.n_lanes += width;
  }
  return lanes;
}

template <typename T>
void BlockVector<T>::Free::operator()(T* p) const {
  ::operator delete[](p, cache_line);
}

template <typename T>
BlockVector<T>::BlockVector(std::size_t n_nodes, const Lanes& lanes)
    : n_nodes_(n_nodes),
      size_(3 * n_nodes * lanes.n_lanes),
      data_(static_cast<T*>(::operator new[](size_ * sizeof(T), cache_line))) {
  parallel_for(size_, 1 << 16,
               [&](std::size_t begin, std::size_t end) { std::fill(data() + begin, data() + end, T(0)); });
}

template <typename T>
void to_block(const Eigen::MatrixXd& columns, Eigen::Index first, const std::vector<std::int32_t>& place,
              const Lanes& lanes, BlockVector<T>& block, const double* factor) {
  for (const auto& group : lanes.groups) {
    T* to = block.data() + 3 * block.n_nodes() * group.first_lane;
    parallel_for(place.size(), 1000, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (int c = 0; c < 3; ++c)
          for (int l = 0; l < group.width; ++l) {
            const std::size_t load = group.first_lane + l;
            to[(3 * std::size_t(place[i]) + c) * group.width + l] =
                load < lanes.n_loads ? static_cast<T>((factor != nullptr ? factor[load] : 1) *
                                                      columns(3 * Eigen::Index(i) + c, first + load))
                                     : T(0);
          }
    });
  }
}

template <typename T>
void from_block(const BlockVector<T>& block, const Lanes& lanes, const std::vector<std::int32_t>& place,
                Eigen::Index first, Eigen::MatrixXd& columns, const double* factor) {
  for (const auto& group : lanes.groups) {
    const T* from = block.data() + 3 * block.n_nodes() * group.first_lane;
    const auto n_used = std::min<std::size_t>(group.width, lanes.n_loads - group.first_lane);
    parallel_for(place.size(), 1000, [&](std::size_t begin, std::size_t end) {
      for (std::size_t l = 0; l < n_used; ++l) {
        const double times = factor != nullptr ? factor[group.first_lane + l] : 1;
        for (std::size_t i = begin; i < end; ++i)
          for (int c = 0; c < 3; ++c)
            columns(3 * Eigen::Index(i) + c, first + group.first_lane + l) =
                times * from[(3 * std::size_t(place[i]) + c) * group.width + l];
      }
    });
  }
}

template Lanes spread_over_lanes<double>(std::size_t, const kernel::Kernels&);
template Lanes spread_over_lanes<float>(std::size_t, const kernel::Kernels&);
template class BlockVector<double>;
template class BlockVector<float>;
template void to_block(const Eigen::MatrixXd&, Eigen::Index, const std::vector<std::int32_t>&, const Lanes&,
                       BlockVector<double>&, const double*);
template void to_block(const Eigen::MatrixXd&, Eigen::Index, const std::vector<std::int32_t>&, const Lanes&,
                       BlockVector<float>&, const double*);
template void from_block(const BlockVector<double>&, const Lanes&, const std::vector<std::int32_t>&,
                         Eigen::Index, Eigen::MatrixXd&, const double*);
template void from_block(const BlockVector<float>&, const Lanes&, const std::vector<std::int32_t>&,
                         Eigen::Index, Eigen::MatrixXd&, const double*);

}  // namespace fem
