#include "fem/multigrid/chebyshev.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>

#include "fem/common/dense_algebra.h"
#include "fem/common/parallel.h"
#include "fem/ranks/array_sums.h"

namespace fem {

namespace {

constexpr std::size_t nodes_at_once = 2048;  // nodes

std::vector<float> invert(const std::vector<double>& blocks) {
  std::vector<float> result(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); i += 9) {
    const Eigen::Map<const Eigen::Matrix3d> block(&blocks[i]);
    const Eigen::Matrix3d inverse =
        block.isZero(0) ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : Eigen::Matrix3d(block.inverse());
    for (int e = 0; e < 9; ++e) result[i + e] = static_cast<float>(inverse.data()[e]);
  }
  return result;
}

}  // namespace

Chebyshev::Chebyshev(const std::vector<double>& diagonal_blocks, const Apply& apply,
                     const kernel::Kernels& kernels, const SharedNodes* shared)
    : kernels_(&kernels), inverse_blocks_(invert(diagonal_blocks)) {
  find_largest_eigenvalue(apply, shared);
}

// Conjugate gradients from noise: their step lengths are the tridiagonal matrix of Lanczos' method, whose
// largest eigenvalue comes up to that of D^-1 K from below, much faster than powers of it do.
void Chebyshev::find_largest_eigenvalue(const Apply& apply, const SharedNodes* shared) {
  constexpr int n_lanczos = 12;
  constexpr float margin = 1.1f;
  const Lanes lanes = spread_over_lanes<float>(1, *kernels_);  // a register of starts
  const std::size_t n = 3 * n_nodes() * lanes.n_lanes;
  BlockVector<float> r(n_nodes(), lanes), p(n_nodes(), lanes), q(n_nodes(), lanes), z(n_nodes(), lanes);
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < n; ++i) {
    random = random * 1664525u + 1013904223u;
    r.data()[i] = static_cast<float>(random >> 8) / (1 << 23) - 1;
  }
  if (shared != nullptr) shared->take_from_owner(lanes, r);
  const std::size_t n_counted = shared == nullptr ? n : 3 * shared->n_counted() * lanes.n_lanes;
  const auto dot = [&](const BlockVector<float>& x, const BlockVector<float>& y) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(lanes.n_lanes);
    for (std::size_t i = 0; i < n_counted; i += lanes.n_lanes)
      for (std::size_t l = 0; l < lanes.n_lanes; ++l)
        sum[l] += double(x.data()[i + l]) * double(y.data()[i + l]);
    if (shared != nullptr) sum = sum_over_ranks(shared->communicator(), sum);
    return sum;
  };
  /// x = a x + b y
  const auto combine = [&](const Eigen::ArrayXd& a, BlockVector<float>& x, const Eigen::ArrayXd& b,
                           const BlockVector<float>& y) {
    const Eigen::ArrayXf to = a.cast<float>(), from = b.cast<float>();
    parallel_for(3 * n_nodes(), nodes_at_once, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * lanes.n_lanes; i < end * lanes.n_lanes; i += lanes.n_lanes)
        for (std::size_t l = 0; l < lanes.n_lanes; ++l)
          x.data()[i + l] = to[l] * x.data()[i + l] + from[l] * y.data()[i + l];
    });
  };
  const Eigen::ArrayXd one = Eigen::ArrayXd::Ones(lanes.n_lanes), none = 0 * one;
  Eigen::ArrayXXd diagonal = Eigen::ArrayXXd::Zero(lanes.n_lanes, n_lanczos), beside = diagonal;
  Eigen::ArrayXd step = one, ratio = none, rz = none;
  for (int k = 0; k < n_lanczos; ++k) {
    parallel_for(n_nodes(), nodes_at_once, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes(), begin, end, {0, 1, true}, inverse_blocks_.data(), r.data(),
                          nullptr, q.data(), z.data());
    });
    const Eigen::ArrayXd now = dot(r, z);
    if (k > 0) {
      ratio = now / rz;
      beside.col(k - 1) = ratio.sqrt() / step;
    }
    rz = now;
    combine(ratio, p, one, z);
    apply(lanes, p, q);
    const Eigen::ArrayXd before = ratio / step;
    step = rz / dot(p, q);
    diagonal.col(k) = 1 / step + before;
    combine(one, r, -step, q);
  }
  for (std::size_t l = 0; l < lanes.n_lanes; ++l) {
    const Eigen::VectorXd middle = diagonal.row(l), side = beside.row(l).head(n_lanczos - 1);
    largest_eigenvalue_ = std::max(
        largest_eigenvalue_, margin * static_cast<float>(largest_eigenvalue_of_tridiagonal(middle, side)));
  }
}

void Chebyshev::smooth(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b,
                       BlockVector<float>& x, bool from_zero, WorkSpace& work) const {
  const float high = largest_eigenvalue_, low = high / range;
  const float theta = (high + low) / 2, delta = (high - low) / 2, sigma = theta / delta;
  float rho = 1 / sigma;
  for (int step = 0; step < n_steps; ++step) {
    kernel::ChebyshevStep coefficients;
    if (step == 0) {
      coefficients = {0, 1 / theta, from_zero};
    } else {
      const float next = 1 / (2 * sigma - rho);
      coefficients = {next * rho, 2 * next / delta, false};
      rho = next;
    }
    if (!coefficients.from_zero) apply(lanes, x, work.image);
    parallel_for(n_nodes(), nodes_at_once, [&](std::size_t begin, std::size_t end) {
      kernels_->chebyshev(lanes.view(), n_nodes(), begin, end, coefficients, inverse_blocks_.data(), b.data(),
                          work.image.data(), work.direction.data(), x.data());
    });
  }
}

void Chebyshev::residual(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b,
                         BlockVector<float>& x, WorkSpace& work) const {
  apply(lanes, x, work.image);
  parallel_for(n_nodes(), nodes_at_once, [&](std::size_t begin, std::size_t end) {
    kernels_->residual(lanes.view(), n_nodes(), begin, end, b.data(), work.image.data());
  });
}

}  // namespace fem
