#include "pipelines/superposition/linear_extremes_kernel.h"

namespace pipelines::kernel {

LinearWalk& linear_walk_for_this_machine() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return avx512::linear_walk;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::linear_walk;
#endif
  return generic::linear_walk;
}

}  // namespace pipelines::kernel
