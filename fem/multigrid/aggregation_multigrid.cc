#include "fem/multigrid/aggregation_multigrid.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fem/common/parallel.h"
#include "fem/multigrid/aggregates.h"
#include "fem/multigrid/rigid_galerkin.h"

namespace fem {

namespace {

constexpr double strong = 0.08;
constexpr std::size_t small = 800;         // aggregates: factorised and solved in no time
constexpr std::size_t rows_at_once = 512;  // nodes

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
  auto motions = rigid_motions(xyz_m);
  for (int siblings = 1;; siblings = 2) {
    Level level;
    level.stiffness = to_float(stiffness);
    level.smoother = std::make_unique<Chebyshev>(
        diagonal(stiffness),
        [&](const Lanes& lanes, const auto& x, auto& y) { multiply(level.stiffness, false, lanes, x, y); },
        *kernels_);
    const auto aggregates = aggregate_nodes(stiffness, siblings, strong);
    auto spanned = span_motions(aggregates, motions);
    level.interpolation = smoothed_interpolation(stiffness, aggregates, spanned.basis,
                                                 4.0 / (3.0 * level.smoother->largest_eigenvalue()));
    stiffness = galerkin_product(stiffness, level.interpolation);
    level.restriction = transpose(level.interpolation);
    motions = std::move(spanned.motion);
    levels_.push_back(std::move(level));
    const bool falls_slowly = 2 * aggregates.n * siblings > aggregates.of_node.size();
    if (aggregates.n > small && !falls_slowly) continue;
    const auto whole = std::max_element(spanned.rank.begin(), spanned.rank.end());
    held_ = static_cast<std::int32_t>(whole - spanned.rank.begin());
    factor_ = factorise_held(stiffness, held_);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
    without_rigid_ = WithoutModes(Eigen::Map<const Rows>(motions.data(), 6 * Eigen::Index(aggregates.n), 6));
    last_place_.resize(2 * aggregates.n);
    std::iota(last_place_.begin(), last_place_.end(), 0);
    return;
  }
}

AggregationMultigrid::WorkSpace AggregationMultigrid::work_space(const Lanes& lanes) const {
  WorkSpace work;
  for (const auto& level : levels_) {
    const std::size_t below = 2 * level.restriction.n_rows();
    work.level.push_back({level.smoother->work_space(lanes), {below, lanes}, {below, lanes}});
  }
  return work;
}

std::size_t AggregationMultigrid::WorkSpace::bytes() const {
  std::size_t sum = 0;
  for (const auto& l : level) sum += l.smoothing.bytes() + l.force_below.bytes() + l.below.bytes();
  return sum;
}

std::size_t AggregationMultigrid::bytes() const {
  auto sum = static_cast<std::size_t>(1e9 * factor_->gigabytes());
  for (const auto& l : levels_)
    sum += l.stiffness.bytes() + l.interpolation.bytes() + l.restriction.bytes() + l.smoother->bytes();
  return sum;
}

void AggregationMultigrid::multiply(const BlockMatrix<float>& matrix, bool keep, const Lanes& lanes,
                                    const BlockVector<float>& x, BlockVector<float>& y) const {
  parallel_for(matrix.n_rows(), rows_at_once, [&](std::size_t begin, std::size_t end) {
    kernels_->combine_blocks(lanes.view(), matrix.n_rows(), matrix.n_columns, begin, end, view(matrix), keep,
                             x.data(), y.data());
  });
}

void AggregationMultigrid::apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                                 WorkSpace& work) const {
  descend(0, lanes, b, x, work);
}

void AggregationMultigrid::descend(std::size_t number, const Lanes& lanes, const BlockVector<float>& b,
                                   BlockVector<float>& x, WorkSpace& work) const {
  if (number == levels_.size()) {
    Eigen::MatrixXd columns(3 * last_place_.size(), lanes.n_loads);
    from_block(b, lanes, last_place_, 0, columns);
    without_rigid_.apply(columns);
    columns.middleRows<6>(6 * Eigen::Index(held_)).setZero();
    columns = factor_->solve(columns);
    without_rigid_.apply(columns);
    to_block(columns, 0, last_place_, lanes, x);
    return;
  }
  const auto& level = levels_[number];
  auto& [smoothed, force_below, below] = work.level[number];
  const auto stiffness = [&](const Lanes& of, const auto& from, auto& to) {
    multiply(level.stiffness, false, of, from, to);
  };
  level.smoother->smooth(lanes, stiffness, b, x, true, smoothed);
  level.smoother->residual(lanes, stiffness, b, x, smoothed);
  multiply(level.restriction, false, lanes, smoothed.image, force_below);
  descend(number + 1, lanes, force_below, below, work);
  multiply(level.interpolation, true, lanes, below, x);
  level.smoother->smooth(lanes, stiffness, b, x, false, smoothed);
}

}  // namespace fem
