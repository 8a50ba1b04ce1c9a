/// y = K x of linear elasticity on isoparametric hexahedra, for a block of load cases, without a matrix.
/// Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/mesh/cell_order.h"
#include "fem/mesh/grid.h"
#include "fem/operators/block_vector.h"
#include "fem/operators/hanging_in_blocks.h"
#include "fem/operators/shared_nodes.h"
#include "fem/operators/stiffness.h"
#include "fem/values/body.h"

namespace fem {

/// What the cells of a mesh know of their geometry: sqrt(JxW) d xi_r / d x_d at the (k+1)^3 Gauss points,
/// cells in the order of CellOrder, 9 numbers per point.
std::vector<double> cell_metric(const Grid& grid, const CellOrder& order);

/// The 3 x 3 diagonal blocks of K (n_nodes x 9), nodes in order; of these cells alone. Zero at hanging nodes.
std::vector<double> diagonal_blocks(const Grid& grid, const CellOrder& order,
                                    const std::vector<double>& metric, const PerCell<Lame>& elastic);

/// Sums are the same bits for every number of threads.
template <typename T>
class ElasticOperator {
public:
  /// @param kernels  one of those of elastic_kernel.h; the machine must have its instructions
  /// @param targets  of another operator on the same cells; none: made here
  /// @param shared   nodes that other ranks add to, too; none: one rank
  ElasticOperator(const Grid& grid, const CellOrder& order, const PerCell<Lame>& elastic,
                  std::vector<double> metric,
                  const kernel::Kernels& kernels = kernel::kernels_for_this_machine(),
                  std::shared_ptr<const AddTargets> targets = nullptr, const SharedNodes* shared = nullptr);

  std::size_t n_nodes() const noexcept { return n_nodes_; }
  const SharedNodes* shared() const noexcept { return shared_; }
  std::shared_ptr<const AddTargets> targets() const noexcept { return targets_; }
  /// Without the targets of another operator.
  std::size_t bytes() const noexcept;

  /// @param x, y  nodes in order; hanging nodes of x are given the values that their masters fix, those of y
  /// have none
  /// @param copies  work space of the operator: made by work_space for the same lanes
  void apply(const Lanes& lanes, BlockVector<T>& x, BlockVector<T>& y, BlockVector<T>& copies) const;
  BlockVector<T> work_space(const Lanes& lanes) const { return {targets_->copy.size(), lanes}; }

private:
  const kernel::Kernels* kernels_;
  std::size_t n_nodes_;
  std::vector<std::size_t> part_begin_;
  bool has_own_targets_;
  std::shared_ptr<const AddTargets> targets_;
  std::vector<T> value_, derivative_, metric_, elastic_;
  HangingInBlocks hanging_;
  const SharedNodes* shared_;
  kernel::CellRange<T> cells_;  // begin, end and pointers are set by apply
};

}  // namespace fem
