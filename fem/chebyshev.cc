#include "fem/chebyshev.h"

#include <Eigen/Dense>
#include <cstdint>

#include "fem/parallel.h"

namespace fem {

namespace {

constexpr std::size_t grain = 2048;  // nodes

std::vector<float> invert(const std::vector<double>& blocks) {
  std::vector<float> result(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); i += 9) {
    const Eigen::Matrix3d inverse = Eigen::Map<const Eigen::Matrix3d>(&blocks[i]).inverse();
    for (int e = 0; e < 9; ++e) result[i + e] = static_cast<float>(inverse.data()[e]);
  }
  return result;
}

}  // namespace

Chebyshev::Chebyshev(const std::vector<double>& diagonal_blocks, const Control& control, const Apply& apply,
                     const kernel::Kernels& kernels)
    : kernels_(&kernels), control_(control), inverse_blocks_(invert(diagonal_blocks)) {
  find_largest_eigenvalue(apply);
}

void Chebyshev::find_largest_eigenvalue(const Apply& apply) {
  const Lanes lanes = spread_over_lanes<float>(1, *kernels_);  // a register of starts
  BlockVector<float> x(n_nodes(), lanes), y(n_nodes(), lanes), d(n_nodes(), lanes);
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < 3 * n_nodes() * lanes.n_lanes; ++i) {
    random = random * 1664525u + 1013904223u;
    x.data()[i] = static_cast<float>(random >> 8) / (1 << 23) - 1;
  }
  constexpr int n_steps = 12;
  const auto norms = [&] {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(lanes.n_lanes);
    for (std::size_t i = 0; i < 3 * n_nodes(); ++i)
      for (std::size_t l = 0; l < lanes.n_lanes; ++l) {
        const double value = x.data()[i * lanes.n_lanes + l];
        sum[l] += value * value;
      }
    return Eigen::ArrayXd(sum.sqrt());
  };
  Eigen::ArrayXd before = norms(), after = before;
  for (int step = 0; step < n_steps; ++step) {
    before = after;
    apply(lanes, x, y);
    parallel_for(n_nodes(), grain, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes(), begin, end, {0, 1, true}, inverse_blocks_.data(), y.data(),
                          nullptr, d.data(), x.data());
    });
    if (step + 2 >= n_steps) after = norms();
  }
  largest_eigenvalue_ = 1.15f * static_cast<float>((after / before).maxCoeff());
}

void Chebyshev::smooth(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b,
                       BlockVector<float>& x, bool from_zero, WorkSpace& work) const {
  const float high = largest_eigenvalue_, low = high / control_.range;
  const float theta = (high + low) / 2, delta = (high - low) / 2, sigma = theta / delta;
  float rho = 1 / sigma;
  for (int step = 0; step < control_.n_steps; ++step) {
    kernel::ChebyshevStep coefficients;
    if (step == 0) {
      coefficients = {0, 1 / theta, from_zero};
    } else {
      const float next = 1 / (2 * sigma - rho);
      coefficients = {next * rho, 2 * next / delta, false};
      rho = next;
    }
    if (!coefficients.from_zero) apply(lanes, x, work.image);
    parallel_for(n_nodes(), grain, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes(), begin, end, coefficients, inverse_blocks_.data(), b.data(),
                          work.image.data(), work.direction.data(), x.data());
    });
  }
}

void Chebyshev::residual(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b,
                         const BlockVector<float>& x, WorkSpace& work) const {
  apply(lanes, x, work.image);
  parallel_for(n_nodes(), grain, [&](std::size_t begin, std::size_t end) {
    kernels_->residual(lanes.view(), n_nodes(), begin, end, b.data(), work.image.data());
  });
}

}  // namespace fem
