/// Rows of nodal matrices between rank 0, which has all nodes, and the ranks, which have some. Internal to
/// fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
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
  template <typename Matrix>
  Matrix from_first(const Matrix& whole, int n_rows) const {
    Matrix part;
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
    if (this_rank(communicator_) != 0) {
      (Message() << part).send(0, communicator_);
      return;
    }
    for (std::size_t r = 0; r < nodes_.size(); ++r) {
      Matrix received;
      if (r > 0) Message::receive(int(r), communicator_) >> received;
      const Matrix& from = r > 0 ? received : part;
      for (std::size_t i = 0; i < nodes_[r].size(); ++i)
        whole.middleRows(n_rows * Eigen::Index(nodes_[r][i]), n_rows) += from.middleRows(n_rows * i, n_rows);
    }
  }

private:
  MPI_Comm communicator_;
  std::vector<std::vector<std::int32_t>> nodes_;
};

}  // namespace fem
