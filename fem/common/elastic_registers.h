/// Registers of the instruction set that a kernel is compiled for. Only for elastic_kernel.cc and
/// vector_kernel.cc: everything here belongs to one file and one variant, so that the linker cannot mix them.
#pragma once

#include "fem/common/elastic_kernel.h"

namespace fem::kernel::KERNEL_VARIANT {
namespace {

#if defined(__AVX512F__)
constexpr int large = 64, small = 32;
#elif defined(__AVX__)
constexpr int large = 32, small = 16;
#else
constexpr int large = 16, small = 0;
#endif

template <typename T, int w>
struct Register {
  typedef T Type __attribute__((vector_size(w * sizeof(T))));
};

template <typename V, typename T>
inline V load(const T* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof(V));
  return v;
}

template <typename V, typename T>
inline void store(T* to, const V& v) {
  __builtin_memcpy(to, &v, sizeof(V));
}

/// Calls the body with each group and its width as a constant.
template <typename T, typename Body>
inline void for_groups(LaneGroups groups, const Body& body) {
  for (int g = 0; g < groups.n; ++g) {
    const auto& group = groups.group[g];
    if (small == 0 || group.width * sizeof(T) == large)
      body(group, Register<T, large / sizeof(T)>());
    else if constexpr (small != 0)
      body(group, Register<T, small / sizeof(T)>());
  }
}

template <typename T, int w>
constexpr int width_of(Register<T, w>) {
  return w;
}

}  // namespace
}  // namespace fem::kernel::KERNEL_VARIANT
