#include "fem/base/common/blas_kernels.h"

#include <unistd.h>

#include <cstdlib>

#include "fem/base/common/library_function.h"

namespace fem {

namespace {

/// The kernels for this processor's vectors; null: none better than the oldest.
const char* kernels_for_this_processor() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return "SKYLAKEX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "HASWELL";
#endif
  return nullptr;
}

}  // namespace

std::string blas_kernels() {
  const auto name = library_function<char*()>("openblas_get_corename");
  return name != nullptr ? name() : "";
}

void restart_with_wide_blas(char** argv) {
  constexpr auto variable = "OPENBLAS_CORETYPE";
  const char* better = kernels_for_this_processor();
  if (better == nullptr || blas_kernels() != "Prescott" || std::getenv(variable) != nullptr) return;
  setenv(variable, better, 0);
  execv("/proc/self/exe", argv);  // comes back only if it fails: slower, and as right
}

}  // namespace fem
