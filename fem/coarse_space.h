/// The trilinear displacements in a mesh of Q2 or Q3 cells: the coarse level of polynomial multigrid.
/// Internal to fem.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem/aggregation_multigrid.h"
#include "fem/block_vector.h"
#include "fem/cell_order.h"
#include "fem/cholmod_factor.h"
#include "fem/elastic_kernel.h"
#include "fem/grid.h"
#include "fem/rigid_modes.h"
#include "fem/solver_choice.h"
#include "fem/stiffness.h"
#include "fem/supports.h"

namespace fem {

/// A sparse matrix between nodes, the same for the three components of displacement.
struct NodeMatrix {
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> column;
  std::vector<float> weight;
  kernel::NodeRows view() const { return {begin.data(), column.data(), weight.data()}; }
};

/// Shape functions are trilinear in the reference coordinates of the cells, whose geometry stays curved: the
/// stiffness is exactly P'K P, P the interpolation, and no cell can be inverted. Its nodes are the corners.
class CoarseSpace {
public:
  /// @param level  factorised or aggregated
  /// @throws std::runtime_error as CholmodFactor
  CoarseSpace(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
              const PerCell<Lame>& elastic, CoarseLevel level, const kernel::Kernels& kernels);

  std::size_t n_nodes() const noexcept { return n_nodes_; }
  const NodeMatrix& interpolation() const noexcept { return interpolation_; }  ///< P, rows: nodes in order
  const NodeMatrix& restriction() const noexcept { return restriction_; }      ///< P'
  std::size_t bytes() const;

  struct WorkSpace {
    AggregationMultigrid::WorkSpace multigrid;
    std::size_t bytes() const { return multigrid.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = (P'K P)^-1 b by a statically determinate support, without rigid motion in b and x; or one V-cycle in
  /// its place.
  void solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

private:
  std::size_t n_nodes_ = 0;
  NodeMatrix interpolation_, restriction_;
  std::vector<std::int32_t> place_;  ///< nodes keep their numbers in block vectors
  WithoutModes without_rigid_;
  std::unique_ptr<Supports> supports_;
  std::unique_ptr<CholmodFactor> factor_;
  std::unique_ptr<AggregationMultigrid> multigrid_;
};

}  // namespace fem
