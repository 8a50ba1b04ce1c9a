/// The coarse level of several MPI ranks, solved on the last one. Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/multigrid/coarse_solver.h"
#include "fem/operators/shared_nodes.h"

namespace fem {

/// The last rank joins the corner meshes of all ranks and adds up their stiffness; forces are added up there,
/// rank after rank, and displacements sent back. The trilinear level has an eighth of the unknowns of Q2
/// cells. Everything here is called on all ranks.
class CoarseOnLastRank {
public:
  /// @param coarse  corners of this rank's cells
  /// @param corner  number in the body of each of them
  /// @param matrix  stiffness of this rank's cells
  /// @throws FailedTogether as CoarseSolver
  CoarseOnLastRank(MPI_Comm communicator, const Grid& coarse, const std::vector<std::int32_t>& corner,
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
  std::vector<std::vector<std::int32_t>> node_;  // last rank: of each rank's corners in the joined mesh
  std::unique_ptr<CoarseSolver> solver_;         // last rank
};

}  // namespace fem
