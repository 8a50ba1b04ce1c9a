#include "fem/aggregation_multigrid.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fem/aggregates.h"
#include "fem/parallel.h"
#include "fem/rigid_galerkin.h"

namespace fem {

namespace {

constexpr double strong = 0.08;
constexpr std::size_t grain = 1024;  // nodes

std::vector<double> diagonal(const BlockMatrix<double>& matrix) {
  std::vector<double> blocks;
  blocks.reserve(9 * matrix.n_rows());
  for (std::size_t i = 0; i < matrix.n_rows(); ++i)
    for (auto k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k)
      if (matrix.column[k] == std::int32_t(i)) blocks.insert(blocks.end(), matrix.at(k), matrix.at(k) + 9);
  return blocks;
}

}  // namespace

AggregationMultigrid::AggregationMultigrid(const NodeGraph& graph, SymmetricMatrix matrix,
                                           const std::vector<double>& xyz_m, const kernel::Kernels& kernels)
    : kernels_(&kernels) {
  auto stiffness = full_rows(graph, matrix);
  matrix = {};
  build(std::move(stiffness), xyz_m);
}

void AggregationMultigrid::build(BlockMatrix<double> stiffness, const std::vector<double>& xyz_m) {
  stiffness_ = to_float(stiffness);
  smoother_ = std::make_unique<Chebyshev>(
      diagonal(stiffness), Chebyshev::Control{5, 20},
      [&](const Lanes& lanes, const auto& x, auto& y) { multiply(lanes, x, y); }, *kernels_);
  const auto aggregates = aggregate_nodes(stiffness, strong);
  std::vector<int> rank;
  const auto motions = rigid_motions(aggregates, xyz_m, rank);
  held_ = static_cast<std::int32_t>(std::max_element(rank.begin(), rank.end()) - rank.begin());
  interpolation_ =
      smoothed_interpolation(stiffness, aggregates, motions, 4.0 / (3.0 * smoother_->largest_eigenvalue()));
  const auto level = rigid_galerkin(stiffness, interpolation_, held_);
  stiffness = {};
  restriction_ = transpose(interpolation_);
  factor_ = factorise(level);
  coarse_place_.resize(2 * aggregates.n);
  std::iota(coarse_place_.begin(), coarse_place_.end(), 0);
}

AggregationMultigrid::WorkSpace AggregationMultigrid::work_space(const Lanes& lanes) const {
  return {smoother_->work_space(lanes), {coarse_place_.size(), lanes}};
}

std::size_t AggregationMultigrid::bytes() const {
  return stiffness_.bytes() + interpolation_.bytes() + restriction_.bytes() + smoother_->bytes() +
         static_cast<std::size_t>(1e9 * factor_->gigabytes());
}

void AggregationMultigrid::multiply(const Lanes& lanes, const BlockVector<float>& x,
                                    BlockVector<float>& y) const {
  const std::size_t n = stiffness_.n_rows();
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    kernels_->combine_blocks(lanes.view(), n, n, begin, end, view(stiffness_), false, x.data(), y.data());
  });
}

void AggregationMultigrid::apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                                 WorkSpace& work) const {
  const auto stiffness = [&](const Lanes& of, const auto& from, auto& to) { multiply(of, from, to); };
  const std::size_t n_nodes = stiffness_.n_rows(), n = n_aggregates();
  smoother_->smooth(lanes, stiffness, b, x, true, work.smoothing);
  smoother_->residual(lanes, stiffness, b, x, work.smoothing);
  parallel_for(n, grain / 32, [&](std::size_t begin, std::size_t end) {
    kernels_->combine_blocks(lanes.view(), n, n_nodes, begin, end, view(restriction_), false,
                             work.smoothing.image.data(), work.coarse.data());
  });
  Eigen::MatrixXd columns(6 * n, lanes.n_loads);
  from_block(work.coarse, lanes, coarse_place_, 0, columns);
  columns.middleRows<6>(6 * Eigen::Index(held_)).setZero();
  to_block(factor_->solve(columns), 0, coarse_place_, lanes, work.coarse);
  parallel_for(n_nodes, grain, [&](std::size_t begin, std::size_t end) {
    kernels_->combine_blocks(lanes.view(), n_nodes, n, begin, end, view(interpolation_), true,
                             work.coarse.data(), x.data());
  });
  smoother_->smooth(lanes, stiffness, b, x, false, work.smoothing);
}

}  // namespace fem
