/// Which variant of the inner loops this machine runs.
#include <algorithm>

#include "pipelines/superpose/kernels/linear_extremes_kernel.h"
#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines::kernel {
namespace {

/// The best of the variants that this machine has the instructions for.
template <class Function>
Function& choose([[maybe_unused]] Function& avx512, [[maybe_unused]] Function& avx2, Function& generic) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2;
#endif
  return generic;
}

#if !defined(__x86_64__)
namespace avx512 = generic;
namespace avx2 = generic;
#endif

}  // namespace

Walk& walk_for_this_machine() {
  return choose(avx512::walk, avx2::walk, generic::walk);
}

LinearWalk& linear_walk_for_this_machine() {
  return choose(avx512::linear_walk, avx2::linear_walk, generic::linear_walk);
}

std::size_t room_of_walk(const Factors& factors) {
  constexpr std::size_t most_lanes = 8;
  const Knots& knots = factors.knots;
  return std::max(batch * factors.n_blocks * most_lanes + factors.n_bounds,
                  3 * knots.n_blocks * block + 2 * knots.n_deviations + 2 * factors.n_channels);
}

std::size_t room_of_linear_walk(const Factors& factors) {
  const Knots& knots = factors.knots;
  return forms_at_once * std::max(factors.n_blocks * block, knots.n_blocks * block + knots.n_deviations);
}

}  // namespace pipelines::kernel
