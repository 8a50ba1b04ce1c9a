/// Solves for the trilinear displacements of a body. Internal to fem.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "fem/loads/supports.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/mesh/grid.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/multigrid/aggregation_multigrid.h"
#include "fem/operators/block_vector.h"
#include "fem/values/solver_choice.h"

namespace fem {

class CoarseSolver {
public:
  /// @param coarse    the mesh of corners, of degree 1
  /// @param assemble  its stiffness; called while its nodes are being ordered
  /// @param level     factorised or aggregated
  /// @throws SolveFailed as CholmodFactor
  CoarseSolver(const Grid& coarse, const NodeGraph& graph, const std::function<SymmetricMatrix()>& assemble,
               CoarseLevel level, const kernel::Kernels& kernels);

  struct WorkSpace {
    AggregationMultigrid::WorkSpace multigrid;
    std::size_t bytes() const { return multigrid.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = K^-1 b by a statically determinate support, without rigid motion in b and x; or one V-cycle in its
  /// place.
  void solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t n_nodes() const noexcept { return place_.size(); }
  std::size_t bytes() const;

private:
  std::vector<std::int32_t> place_;  ///< nodes keep their numbers in block vectors
  WithoutModes without_rigid_;
  std::unique_ptr<Supports> supports_;
  std::unique_ptr<CholmodFactor> factor_;
  std::unique_ptr<AggregationMultigrid> multigrid_;
};

}  // namespace fem
