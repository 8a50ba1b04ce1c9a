/// Nodes that the cells of several ranks have in common, in block vectors. Internal to fem.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "fem/operators/block_vector.h"
#include "fem/operators/subdomain.h"

namespace fem {

/// Sums are taken in the order of ranks, so that all ranks that have a node get the same bits for it.
/// Everything here is called on all ranks.
class SharedNodes {
public:
  /// @param neighbours  their nodes in the order of the block vectors; each list in an order that both sides
  /// have
  /// @param n_counted   the first nodes in order are counted by this rank, the rest by another one
  /// @param body_node   number in the body of each node in order
  SharedNodes(MPI_Comm communicator, std::vector<Neighbour> neighbours, std::size_t n_counted,
              std::vector<std::int32_t> body_node);

  MPI_Comm communicator() const noexcept { return communicator_; }
  std::size_t n_counted() const noexcept { return n_counted_; }
  std::size_t n_in_body() const noexcept { return n_in_body_; }
  const std::vector<std::int32_t>& body_node() const noexcept { return body_node_; }

  /// Adds up what the ranks have at their common nodes.
  template <typename T>
  void sum(const Lanes& lanes, BlockVector<T>& vector) const;
  /// The same for `per_node` numbers at each node.
  void sum(std::vector<double>& values, std::size_t per_node) const;
  /// What the rank that counts a node has there, on the others too.
  template <typename T>
  void take_from_owner(const Lanes& lanes, BlockVector<T>& vector) const;

private:
  template <typename T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& sent) const;

  /// Where the contribution of one rank to a common node is.
  struct Source {
    std::int32_t neighbour = -1;  ///< -1: one's own
    std::int32_t place = 0;       ///< in the neighbour's list
  };

  MPI_Comm communicator_;
  std::vector<Neighbour> neighbours_;
  std::size_t n_counted_, n_in_body_ = 0;
  std::vector<std::int32_t> body_node_;
  std::vector<std::int32_t> common_;  // nodes with neighbours, ascending
  std::vector<std::size_t> begin_;    // of the sources of each, ranks ascending
  std::vector<Source> source_;
};

}  // namespace fem
