#include "fem/solvers/block_cg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/common/parallel.h"
#include "fem/ranks/array_sums.h"

namespace fem {

namespace {

constexpr std::size_t chunk = 2048;  // nodes; sums are taken chunk after chunk on every number of threads
constexpr int n_patient = 25;        // iterations
constexpr double least_progress = 0.9;
constexpr int n_before_forecast = 30;

/// Sums over all nodes of what a kernel returns for a range; `n` sums per lane. The kernel is called for
/// nodes that another rank counts, too.
template <int n, typename Body>
std::array<Eigen::ArrayXd, n> sum_over_nodes(std::size_t n_nodes, const SharedNodes* shared,
                                             std::size_t n_lanes, const Body& body) {
  const std::size_t n_counted = shared == nullptr ? n_nodes : shared->n_counted();
  const std::size_t n_chunks = (n_counted + chunk - 1) / chunk;
  Eigen::MatrixXd partial(n * n_lanes, n_chunks);
  parallel_for(n_chunks, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      body(k * chunk, std::min(n_counted, (k + 1) * chunk), partial.col(k).data());
  });
  Eigen::ArrayXd total = Eigen::ArrayXd::Zero(n * n_lanes);
  for (std::size_t k = 0; k < n_chunks; ++k) total += partial.col(k).array();
  if (shared != nullptr) {
    Eigen::ArrayXd elsewhere(n * n_lanes);
    if (n_counted < n_nodes) body(n_counted, n_nodes, elsewhere.data());
    total = sum_over_ranks(shared->communicator(), total);
  }
  std::array<Eigen::ArrayXd, n> result;
  for (int i = 0; i < n; ++i) result[i] = total.segment(i * n_lanes, n_lanes);
  return result;
}

template <typename Body>
void for_chunks(std::size_t n_nodes, const Body& body) {
  parallel_for(n_nodes, chunk, [&](std::size_t begin, std::size_t end) { body(begin, end); });
}

}  // namespace

BlockCgResult solve_block(const ElasticOperator<double>& stiffness, const PolynomialMultigrid& preconditioner,
                          const kernel::Kernels& kernels, const Lanes& lanes, const BlockCgControl& control,
                          BlockVector<double>& u, BlockVector<double>& r) {
  const std::size_t n_nodes = stiffness.n_nodes(), n_lanes = lanes.n_lanes;
  const auto* shared = stiffness.shared();
  const std::size_t n_in_body = shared == nullptr ? n_nodes : shared->n_in_body();
  const Lanes floats = spread_over_lanes<float>(lanes.n_loads, kernels);
  BlockVector<double> p(n_nodes, lanes), q(n_nodes, lanes);
  BlockVector<float> b(n_nodes, floats), z(n_nodes, floats);
  auto copies = stiffness.work_space(lanes);
  auto work = preconditioner.work_space(floats);
  BlockCgResult result;
  result.bytes =
      u.bytes() + r.bytes() + p.bytes() + q.bytes() + b.bytes() + z.bytes() + copies.bytes() + work.bytes();

  Eigen::ArrayXd tolerance = Eigen::ArrayXd::Zero(n_lanes);
  tolerance.head(lanes.n_loads) = control.tolerance;
  Eigen::ArrayXd rr = sum_over_nodes<1>(n_nodes, shared, n_lanes, [&](auto begin, auto end, double* sum) {
    kernels.dot(lanes.view(), n_nodes, begin, end, r.data(), r.data(), sum);
  })[0];
  Eigen::ArrayXd rz_before = Eigen::ArrayXd::Zero(n_lanes), step = rz_before, factor = rz_before,
                 scale = rz_before;
  double best = std::numeric_limits<double>::infinity(), first_worst = 0;
  int best_at = 0;
  while (true) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> active = rr.sqrt() > tolerance;
    if (!rr.isFinite().all()) {
      result.end = BlockCgEnd::broke_down;
      return result;
    }
    if (!active.any()) return result;
    const double worst = active.select((rr.sqrt() / tolerance.max(1e-300)).log(), -1e300).maxCoeff();
    if (worst < best + std::log(least_progress)) best = worst, best_at = result.n_iterations;
    if (result.n_iterations - best_at >= n_patient) {
      result.end = BlockCgEnd::not_falling;
      return result;
    }
    // At the mean pace so far twice the iterations allowed would not do: it is not worth going on.
    if (result.n_iterations == 0) first_worst = worst;
    const bool hopeless =
        result.n_iterations >= n_before_forecast &&
        result.n_iterations * first_worst > 2.0 * control.max_iterations * (first_worst - worst);
    if (hopeless || result.n_iterations == control.max_iterations) {
      result.end = BlockCgEnd::too_many_iterations;
      return result;
    }
    ++result.n_iterations;

    // The preconditioner sees residuals of size 1, whatever they have fallen to.
    const double size = std::sqrt(3.0 * double(n_in_body));
    scale = active.select(size / rr.sqrt().max(1e-300), 0.0);
    for_chunks(n_nodes, [&](auto begin, auto end) {
      kernels.to_float(lanes.view(), floats.view(), n_nodes, begin, end, scale.data(), r.data(), b.data());
    });
    preconditioner.apply(floats, b, z, work);
    const auto dots = sum_over_nodes<2>(n_nodes, shared, n_lanes, [&](auto begin, auto end, double* sums) {
      kernels.dots_with_float(lanes.view(), floats.view(), n_nodes, begin, end, r.data(), q.data(), z.data(),
                              sums, sums + n_lanes);
    });
    // beta = z.(r - r_before) / (r.z)_before with r - r_before = -step q
    factor = (active && rz_before > 0).select(-step * dots[1] / rz_before, 0.0);
    for_chunks(n_nodes, [&](auto begin, auto end) {
      kernels.direction(lanes.view(), floats.view(), n_nodes, begin, end, factor.data(), z.data(), p.data());
    });
    stiffness.apply(lanes, p, q, copies);
    const auto pq = sum_over_nodes<1>(n_nodes, shared, n_lanes, [&](auto begin, auto end, double* sum) {
      kernels.dot(lanes.view(), n_nodes, begin, end, p.data(), q.data(), sum);
    })[0];
    if ((active && !(pq > 0 && dots[0] > 0)).any()) {
      result.end = BlockCgEnd::broke_down;
      return result;
    }
    step = active.select(dots[0] / pq, 0.0);
    rz_before = dots[0];
    rr = sum_over_nodes<1>(n_nodes, shared, n_lanes, [&](auto begin, auto end, double* sum) {
      kernels.advance(lanes.view(), n_nodes, begin, end, step.data(), p.data(), q.data(), u.data(), r.data(),
                      sum);
    })[0];
  }
}

Eigen::ArrayXd subtract_image(const ElasticOperator<double>& stiffness, const kernel::Kernels& kernels,
                              const Lanes& lanes, BlockVector<double>& u, BlockVector<double>& r) {
  const std::size_t n_nodes = stiffness.n_nodes();
  BlockVector<double> image(n_nodes, lanes);
  auto copies = stiffness.work_space(lanes);
  stiffness.apply(lanes, u, image, copies);
  for_chunks(3 * n_nodes * lanes.n_lanes, [&](auto begin, auto end) {
    for (auto i = begin; i < end; ++i) r.data()[i] -= image.data()[i];
  });
  return sum_over_nodes<1>(n_nodes, stiffness.shared(), lanes.n_lanes,
                           [&](auto begin, auto end, double* sum) {
                             kernels.dot(lanes.view(), n_nodes, begin, end, r.data(), r.data(), sum);
                           })[0];
}

}  // namespace fem
