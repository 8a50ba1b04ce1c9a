#include "pipelines/superposition/superposition_kernel.h"

namespace pipelines::kernel {

Walk& walk_for_this_machine() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return avx512::walk;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::walk;
#endif
  return generic::walk;
}

}  // namespace pipelines::kernel
