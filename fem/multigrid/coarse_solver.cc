#include "fem/multigrid/coarse_solver.h"

#include <future>
#include <numeric>

#include "fem/loads/clamps.h"

namespace fem {

CoarseSolver::CoarseSolver(const Grid& coarse, const NodeGraph& graph,
                           const std::function<SymmetricMatrix()>& assemble, CoarseLevel level,
                           const kernel::Kernels& kernels)
    : place_(coarse.n_nodes) {
  std::iota(place_.begin(), place_.end(), 0);
  if (level == CoarseLevel::aggregated) {
    multigrid_ = std::make_unique<AggregationMultigrid>(graph, assemble(), coarse.xyz_m, kernels);
    return;
  }
  auto node_order = std::async(std::launch::async, order_nodes, std::cref(graph));
  auto matrix = assemble();
  supports_ = std::make_unique<Supports>(choose_supports(coarse), matrix);
  factor_ = std::make_unique<CholmodFactor>(graph, node_order.get());
  factor_->factorise(matrix);
  Eigen::MatrixXd rigid = rigid_modes(coarse, Eigen::Vector3d::Zero());
  for (const auto node : coarse.hanging.node) rigid.middleRows<3>(3 * Eigen::Index(node)).setZero();
  without_rigid_ = WithoutModes(rigid);
}

std::size_t CoarseSolver::bytes() const {
  return multigrid_ ? multigrid_->bytes() : static_cast<std::size_t>(1e9 * factor_->gigabytes());
}

CoarseSolver::WorkSpace CoarseSolver::work_space(const Lanes& lanes) const {
  if (multigrid_) return {multigrid_->work_space(lanes)};
  return {};
}

void CoarseSolver::solve(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                         WorkSpace& work) const {
  if (multigrid_) return multigrid_->apply(lanes, b, x, work.multigrid);
  Eigen::MatrixXd columns(3 * n_nodes(), lanes.n_loads);
  from_block(b, lanes, place_, 0, columns);
  without_rigid_.apply(columns);
  clear_rows(supports_->unknowns(), columns);
  columns = factor_->solve(columns);
  without_rigid_.apply(columns);
  to_block(columns, 0, place_, lanes, x);
}

}  // namespace fem
