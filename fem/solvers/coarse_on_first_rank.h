/// The coarse level of several MPI ranks, solved on rank 0. Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/operators/shared_nodes.h"
#include "fem/solvers/coarse_solver.h"

namespace fem {

/// Rank 0 joins the corner meshes of all ranks and adds up their stiffness; forces are added up there, rank
/// after rank, and displacements sent back. The trilinear level has an eighth of the unknowns of Q2 cells.
/// Everything here is called on all ranks.
class CoarseOnFirstRank {
public:
  /// @param coarse  corners of this rank's cells
  /// @param corner  number in the body of each of them
  /// @param matrix  stiffness of this rank's cells
  /// @throws FailedTogether as CoarseSolver
  CoarseOnFirstRank(MPI_Comm communicator, const Grid& coarse, const std::vector<std::int32_t>& corner,
                    const SymmetricMatrix& matrix, CoarseLevel level, const kernel::Kernels& kernels);

  struct WorkSpace {
    BlockVector<float> force, displacement;
    CoarseSolver::WorkSpace below;
    std::size_t bytes() const { return force.bytes() + displacement.bytes() + below.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// @param b  forces of this rank's share alone
  void solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t bytes() const { return solver_ ? solver_->bytes() : 0; }

private:
  MPI_Comm communicator_;
  std::vector<std::vector<std::int32_t>> node_;  // rank 0: of each rank's corners in the joined mesh
  std::unique_ptr<CoarseSolver> solver_;         // rank 0
};

}  // namespace fem
