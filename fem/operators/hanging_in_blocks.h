/// Hanging nodes in block vectors. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid.h"
#include "fem/operators/block_vector.h"

namespace fem {

/// What HangingNodes says, by the places of nodes in block vectors. Same bits for every number of threads.
class HangingInBlocks {
public:
  /// @param place  of each node in block vectors
  HangingInBlocks(const HangingNodes& hanging, const std::vector<std::int32_t>& place);

  bool is_empty() const noexcept { return of_masters_.row.empty(); }

  /// Gives every hanging node the value that its masters fix.
  template <typename T>
  void set(const Lanes& lanes, BlockVector<T>& vector) const;

  /// Forces at hanging nodes go to their masters; none are left at the nodes.
  template <typename T>
  void move_to_masters(const Lanes& lanes, BlockVector<T>& vector) const;

private:
  /// Rows of weights: that of `row[i]` is begin[i] .. begin[i + 1] - 1.
  struct Rows {
    std::vector<std::int32_t> row;
    std::vector<std::size_t> begin{0};
    std::vector<std::int32_t> column;
    std::vector<double> weight;
  };

  /// Adds the products of the rows to the values of their nodes, of `n` numbers each.
  template <typename T>
  static void add(const Rows& rows, std::size_t n, T* values);
  template <typename T>
  void clear_hanging(std::size_t n, T* values) const;

  Rows of_masters_, of_hanging_;  ///< values at hanging nodes from masters; forces at masters from those
};

}  // namespace fem
