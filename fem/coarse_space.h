/// The trilinear displacements in a mesh of Q2 or Q3 cells: the coarse level of polynomial multigrid.
/// Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/cell_order.h"
#include "fem/cholmod_factor.h"
#include "fem/elastic_kernel.h"
#include "fem/grid.h"
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
  /// @throws std::runtime_error as CholmodFactor
  CoarseSpace(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
              const PerCell<Lame>& elastic);

  std::size_t n_nodes() const noexcept { return n_nodes_; }
  const NodeMatrix& interpolation() const noexcept { return interpolation_; }  ///< P, rows: nodes in order
  const NodeMatrix& restriction() const noexcept { return restriction_; }      ///< P'
  double gigabytes() const { return factor_->gigabytes(); }

  /// (P'K P)^-1 on the statically determinate support, whose rows are held at zero.
  Eigen::MatrixXd solve(Eigen::MatrixXd force) const;

private:
  std::size_t n_nodes_ = 0;
  NodeMatrix interpolation_, restriction_;
  std::unique_ptr<Supports> supports_;
  std::unique_ptr<CholmodFactor> factor_;
};

}  // namespace fem
