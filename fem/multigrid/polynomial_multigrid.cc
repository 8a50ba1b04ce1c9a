#include "fem/multigrid/polynomial_multigrid.h"

#include "fem/common/parallel.h"

namespace fem {

namespace {

constexpr std::size_t level_nodes_at_once = 2048;  // nodes

}  // namespace

PolynomialMultigrid::PolynomialMultigrid(const Grid& grid, const CellOrder& order,
                                         const std::vector<double>& metric, const PerCell<Lame>& elastic,
                                         CoarseLevel level, const kernel::Kernels& kernels,
                                         const SharedNodes* shared)
    : kernels_(&kernels),
      shared_(shared),
      coarse_(grid, order, metric, elastic, level, kernels, shared),
      operator_(grid, order, elastic, metric, kernels, nullptr, shared) {
  auto diagonal = diagonal_blocks(grid, order, metric, elastic);
  if (shared_ != nullptr) shared_->sum(diagonal, 9);
  smoother_ = std::make_unique<Chebyshev>(
      diagonal,
      [&](const Lanes& lanes, auto& x, auto& y) {
        auto copies = operator_.work_space(lanes);
        operator_.apply(lanes, x, y, copies);
      },
      kernels, shared);
}

PolynomialMultigrid::WorkSpace PolynomialMultigrid::work_space(const Lanes& lanes) const {
  return {smoother_->work_space(lanes),
          operator_.work_space(lanes),
          {coarse_.n_nodes(), lanes},
          {coarse_.n_nodes(), lanes},
          coarse_.work_space(lanes)};
}

std::size_t PolynomialMultigrid::bytes() const {
  return operator_.bytes() + smoother_->bytes() + coarse_.bytes();
}

void PolynomialMultigrid::apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                                WorkSpace& work) const {
  const std::size_t n_nodes = operator_.n_nodes(), n_coarse = coarse_.n_nodes();
  const auto stiffness = [&](const Lanes& of, auto& from, auto& to) {
    operator_.apply(of, from, to, work.copies);
  };
  smoother_->smooth(lanes, stiffness, b, x, true, work.smoothing);
  smoother_->residual(lanes, stiffness, b, x, work.smoothing);
  parallel_for(n_coarse, level_nodes_at_once / 8, [&](std::size_t begin, std::size_t end) {
    kernels_->combine(lanes.view(), n_coarse, n_nodes, begin, end, node_view(coarse_.restriction()), false,
                      work.smoothing.image.data(), work.coarse_force.data());
  });
  coarse_.solve(lanes, work.coarse_force, work.coarse, work.below);
  parallel_for(n_nodes, level_nodes_at_once, [&](std::size_t begin, std::size_t end) {
    kernels_->combine(lanes.view(), n_nodes, n_coarse, begin, end, node_view(coarse_.interpolation()), true,
                      work.coarse.data(), x.data());
  });
  // The cells of two ranks interpolate the same value at a common node, but for rounding.
  if (shared_ != nullptr) shared_->take_from_owner(lanes, x);
  smoother_->smooth(lanes, stiffness, b, x, false, work.smoothing);
}

}  // namespace fem
