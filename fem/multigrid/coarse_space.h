/// The trilinear displacements in a mesh of Q2 or Q3 cells: the coarse level of polynomial multigrid.
/// Internal to fem.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem/common/elastic_kernel.h"
#include "fem/matrices/block_matrix.h"
#include "fem/mesh/cell_order.h"
#include "fem/mesh/grid.h"
#include "fem/multigrid/coarse_on_last_rank.h"
#include "fem/multigrid/coarse_solver.h"
#include "fem/operators/block_vector.h"
#include "fem/operators/shared_nodes.h"
#include "fem/operators/stiffness.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// A sparse matrix between nodes, the same for the three components of displacement: blocks of 1 x 1.
using NodeMatrix = BlockMatrix<float>;

/// Shape functions are trilinear in the reference coordinates of the cells, whose geometry stays curved: the
/// stiffness is exactly P'K P, P the interpolation, and no cell can be inverted. Its nodes are the corners.
class CoarseSpace {
public:
  /// @param level  factorised or aggregated
  /// @param shared  nodes that other ranks have, too, whose cells' stiffness adds to that of these; none: one
  /// rank
  /// @throws SolveFailed as CoarseSolver
  CoarseSpace(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
              const PerCell<Lame>& elastic, CoarseLevel level, const kernel::Kernels& kernels,
              const SharedNodes* shared = nullptr);

  std::size_t n_nodes() const noexcept { return n_nodes_; }
  const NodeMatrix& interpolation() const noexcept { return interpolation_; }  ///< P, rows: nodes in order
  /// P', of the nodes that this rank counts.
  const NodeMatrix& restriction() const noexcept { return restriction_; }
  std::size_t bytes() const;

  struct WorkSpace {
    CoarseSolver::WorkSpace alone;
    CoarseOnLastRank::WorkSpace on_last_rank;
    std::size_t bytes() const { return alone.bytes() + on_last_rank.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = (P'K P)^-1 b as CoarseSolver; b: what the nodes that this rank counts bring to it.
  void solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

private:
  std::size_t n_nodes_ = 0;
  NodeMatrix interpolation_, restriction_;
  std::unique_ptr<CoarseSolver> solver_;            // one rank
  std::unique_ptr<CoarseOnLastRank> on_last_rank_;  // several
};

}  // namespace fem
