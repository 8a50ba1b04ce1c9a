#include "fem/polynomial_multigrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/parallel.h"

namespace fem {

namespace {

// Measured on shafts: 4 to 6 steps cost the same; the wider range suits stretched cells.
constexpr int n_smoothing_steps = 5;
constexpr float smoothing_range = 20;  // largest eigenvalue over the smallest that is smoothed
constexpr std::size_t grain = 2048;    // nodes

std::vector<float> invert(const std::vector<double>& blocks) {
  std::vector<float> result(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); i += 9) {
    const Eigen::Matrix3d inverse = Eigen::Map<const Eigen::Matrix3d>(&blocks[i]).inverse();
    for (int e = 0; e < 9; ++e) result[i + e] = static_cast<float>(inverse.data()[e]);
  }
  return result;
}

std::vector<std::int32_t> identity(std::size_t n) {
  std::vector<std::int32_t> result(n);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

}  // namespace

PolynomialMultigrid::PolynomialMultigrid(const Grid& grid, const CellOrder& order,
                                         const std::vector<double>& metric, const PerCell<Lame>& elastic,
                                         const kernel::Kernels& kernels)
    : kernels_(&kernels),
      operator_(grid, order, elastic, metric, kernels),
      coarse_(grid, order, metric, elastic),
      inverse_blocks_(invert(diagonal_blocks(grid, order, metric, elastic))),
      coarse_place_(identity(coarse_.n_nodes())) {
  find_largest_eigenvalue();
}

PolynomialMultigrid::WorkSpace PolynomialMultigrid::work_space(const Lanes& lanes) const {
  return {{operator_.n_nodes(), lanes},
          {operator_.n_nodes(), lanes},
          operator_.work_space(lanes),
          {coarse_.n_nodes(), lanes}};
}

std::size_t PolynomialMultigrid::bytes() const {
  const auto of = [](const NodeMatrix& m) { return 8 * (m.begin.size() + m.column.size()); };
  return operator_.bytes() + 4 * inverse_blocks_.size() + of(coarse_.interpolation()) +
         of(coarse_.restriction()) + static_cast<std::size_t>(1e9 * coarse_.gigabytes());
}

void PolynomialMultigrid::find_largest_eigenvalue() {
  const Lanes lanes = spread_over_lanes<float>(1, *kernels_);  // a register of starts
  const std::size_t n_nodes = operator_.n_nodes();
  BlockVector<float> x(n_nodes, lanes), y(n_nodes, lanes), d(n_nodes, lanes);
  auto copies = operator_.work_space(lanes);
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < 3 * n_nodes * lanes.n_lanes; ++i) {
    random = random * 1664525u + 1013904223u;
    x.data()[i] = static_cast<float>(random >> 8) / (1 << 23) - 1;
  }
  constexpr int n_steps = 12;
  const auto norms = [&] {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(lanes.n_lanes);
    for (std::size_t i = 0; i < 3 * n_nodes; ++i)
      for (std::size_t l = 0; l < lanes.n_lanes; ++l) {
        const double value = x.data()[i * lanes.n_lanes + l];
        sum[l] += value * value;
      }
    return Eigen::ArrayXd(sum.sqrt());
  };
  Eigen::ArrayXd before = norms(), after = before;
  for (int step = 0; step < n_steps; ++step) {
    before = after;
    operator_.apply(lanes, x, y, copies);
    parallel_for(n_nodes, grain, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes, begin, end, {0, 1, true}, inverse_blocks_.data(), y.data(),
                          nullptr, d.data(), x.data());
    });
    if (step + 2 >= n_steps) after = norms();
  }
  largest_eigenvalue_ = 1.15f * static_cast<float>((after / before).maxCoeff());
}

void PolynomialMultigrid::smooth(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                                 bool from_zero, WorkSpace& work) const {
  const std::size_t n_nodes = operator_.n_nodes();
  const float high = largest_eigenvalue_, low = high / smoothing_range;
  const float theta = (high + low) / 2, delta = (high - low) / 2, sigma = theta / delta;
  float rho = 1 / sigma;
  for (int step = 0; step < n_smoothing_steps; ++step) {
    kernel::ChebyshevStep coefficients;
    if (step == 0) {
      coefficients = {0, 1 / theta, from_zero};
    } else {
      const float next = 1 / (2 * sigma - rho);
      coefficients = {next * rho, 2 * next / delta, false};
      rho = next;
    }
    if (!coefficients.from_zero) operator_.apply(lanes, x, work.image, work.copies);
    parallel_for(n_nodes, grain, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes, begin, end, coefficients, inverse_blocks_.data(), b.data(),
                          work.image.data(), work.direction.data(), x.data());
    });
  }
}

void PolynomialMultigrid::apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
                                WorkSpace& work) const {
  const std::size_t n_nodes = operator_.n_nodes(), n_coarse = coarse_.n_nodes();
  smooth(lanes, b, x, true, work);
  operator_.apply(lanes, x, work.image, work.copies);
  parallel_for(n_nodes, grain, [&](std::size_t begin, std::size_t end) {
    kernels_->residual(lanes.view(), n_nodes, begin, end, b.data(), work.image.data());
  });
  parallel_for(n_coarse, grain / 8, [&](std::size_t begin, std::size_t end) {
    kernels_->combine(lanes.view(), n_coarse, n_nodes, begin, end, coarse_.restriction().view(), false,
                      work.image.data(), work.coarse.data());
  });
  Eigen::MatrixXd columns(3 * n_coarse, lanes.n_loads);
  from_block(work.coarse, lanes, coarse_place_, 0, columns);
  to_block(coarse_.solve(std::move(columns)), 0, coarse_place_, lanes, work.coarse);
  parallel_for(n_nodes, grain, [&](std::size_t begin, std::size_t end) {
    kernels_->combine(lanes.view(), n_nodes, n_coarse, begin, end, coarse_.interpolation().view(), true,
                      work.coarse.data(), x.data());
  });
  smooth(lanes, b, x, false, work);
}

}  // namespace fem
