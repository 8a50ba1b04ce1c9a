/// Nodal vectors of many load cases at once, arranged for the registers of this machine (elastic_kernel.h).
/// Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "fem/common/elastic_kernel.h"

namespace fem {

/// How load cases are spread over registers; doubles and floats alike begin at lane 0, so that load case k is
/// lane k of both.
struct Lanes {
  std::size_t n_loads = 0;
  std::size_t n_lanes = 0;  ///< with those that only fill the last register
  std::vector<kernel::LaneGroup> groups;
  kernel::LaneGroups view() const { return {groups.data(), static_cast<int>(groups.size())}; }
};
template <typename T>
Lanes spread_over_lanes(std::size_t n_loads, const kernel::Kernels& kernels);

/// 3 n_nodes rows of n_lanes numbers, zero at first, on the border of a cache line.
template <typename T>
class BlockVector {
public:
  BlockVector() = default;
  BlockVector(std::size_t n_nodes, const Lanes& lanes);
  T* data() noexcept { return data_.get(); }
  const T* data() const noexcept { return data_.get(); }
  std::size_t n_nodes() const noexcept { return n_nodes_; }
  std::size_t bytes() const noexcept { return size_ * sizeof(T); }

private:
  struct Free {
    void operator()(T* p) const;
  };
  std::size_t n_nodes_ = 0, size_ = 0;
  std::unique_ptr<T[], Free> data_;
};

/// Columns of a matrix (3 n_nodes x loads) into a block vector and back. Node i of the matrix is node
/// place[i] of the block vector; lanes without a column become zero.
/// @param factor  of each load case, multiplied on the way; none: 1
template <typename T>
void to_block(const Eigen::MatrixXd& columns, Eigen::Index first, const std::vector<std::int32_t>& place,
              const Lanes& lanes, BlockVector<T>& block, const double* factor = nullptr);
template <typename T>
void from_block(const BlockVector<T>& block, const Lanes& lanes, const std::vector<std::int32_t>& place,
                Eigen::Index first, Eigen::MatrixXd& columns, const double* factor = nullptr);

}  // namespace fem
