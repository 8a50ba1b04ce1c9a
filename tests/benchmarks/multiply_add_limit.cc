/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant.
#include "tests/benchmarks/multiply_add_limit.h"

#include "pipelines/superpose/kernels/lanes.h"

namespace benchmarks::limit::KERNEL_VARIANT {

double multiply_adds(std::size_t n_rounds, double& sum) {
  using pipelines::kernel::KERNEL_VARIANT::Lanes, pipelines::kernel::KERNEL_VARIANT::n_lanes;
  constexpr std::size_t n_chains = n_lanes == 8 ? 24 : 12;
  Lanes chains[n_chains];
  for (std::size_t i = 0; i < n_chains; ++i) chains[i] = Lanes{} + double(i);
  const Lanes factor = Lanes{} + 0.75, more = Lanes{} + sum;
  for (std::size_t round = 0; round < n_rounds; ++round)
#pragma GCC unroll 24
    for (std::size_t i = 0; i < n_chains; ++i) chains[i] = chains[i] * factor + more;
  for (std::size_t i = 0; i < n_chains; ++i)
    for (std::size_t lane = 0; lane < n_lanes; ++lane) sum += chains[i][lane];
  return 2.0 * double(n_rounds * n_chains * n_lanes);
}

}  // namespace benchmarks::limit::KERNEL_VARIANT
