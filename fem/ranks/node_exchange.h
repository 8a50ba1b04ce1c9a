/// Rows of nodal matrices between rank 0, which has all nodes, and the ranks, which have some. Internal to
/// fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "fem/ranks/message.h"
#include "fem/ranks/ranks.h"

namespace fem {

/// Called on all ranks.
class NodeExchange {
public:
  /// @param nodes  of each rank, on rank 0; empty elsewhere
  NodeExchange(MPI_Comm communicator, std::vector<std::vector<std::int32_t>> nodes)
      : communicator_(communicator), nodes_(std::move(nodes)) {}

  /// @param whole  on rank 0: all nodes, `n_rows` rows each
  /// @return the rows of this rank's nodes
  template <typename Whole>
  typename Whole::PlainObject from_first(const Whole& whole, int n_rows) const {
    typename Whole::PlainObject part;
    if (this_rank(communicator_) != 0) {
      Message::receive(0, communicator_) >> part;
      return part;
    }
    for (std::size_t r = nodes_.size(); r-- > 0;) {
      part.resize(n_rows * nodes_[r].size(), whole.cols());
      for (std::size_t i = 0; i < nodes_[r].size(); ++i)
        part.middleRows(n_rows * i, n_rows) = whole.middleRows(n_rows * Eigen::Index(nodes_[r][i]), n_rows);
      if (r > 0) (Message() << part).send(int(r), communicator_);
    }
    return part;
  }

  /// Rank after rank into the rows of its nodes, which it adds to.
  /// @param whole  changed on rank 0
  template <typename Matrix, typename Whole>
  void add_on_first(const Matrix& part, int n_rows, Whole& whole) const {
    constexpr std::size_t at_once = 16384;  // nodes: rank 0 has no room for all of another rank's
    if (this_rank(communicator_) != 0) {
      const auto n_nodes = std::size_t(part.rows() / n_rows);
      for (std::size_t first = 0; first < n_nodes; first += at_once) {
        const Matrix piece = part.middleRows(n_rows * first, n_rows * std::min(at_once, n_nodes - first));
        (Message() << piece).send(0, communicator_);
      }
      return;
    }
    for (std::size_t r = 0; r < nodes_.size(); ++r)
      for (std::size_t first = 0; first < nodes_[r].size(); first += at_once) {
        Matrix received;
        if (r > 0) Message::receive(int(r), communicator_) >> received;
        const Matrix& from = r > 0 ? received : part;
        const std::size_t begin = r > 0 ? first : 0;
        for (std::size_t i = first; i < std::min(first + at_once, nodes_[r].size()); ++i)
          whole.middleRows(n_rows * Eigen::Index(nodes_[r][i]), n_rows) +=
              from.middleRows(n_rows * (i - begin), n_rows);
      }
  }

private:
  MPI_Comm communicator_;
  std::vector<std::vector<std::int32_t>> nodes_;
};

}  // namespace fem
