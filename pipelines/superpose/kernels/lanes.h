/// One hardware register of doubles, for the files that are compiled once per instruction set, with
/// KERNEL_VARIANT naming the variant (pipelines/CMakeLists.txt). What is inline here lies in the variant's
/// namespace: the linker would keep one copy of anything else, for one instruction set, for all callers.
#pragma once

#include <cstddef>

namespace pipelines::kernel::KERNEL_VARIANT {

// A longer vector would be taken apart by the compiler, badly.
#if defined(__AVX512F__)
constexpr std::size_t n_lanes = 8;
#elif defined(__AVX__)
constexpr std::size_t n_lanes = 4;
#else
constexpr std::size_t n_lanes = 2;
#endif
using Lanes = double __attribute__((vector_size(8 * n_lanes)));
using Indices = long __attribute__((vector_size(8 * n_lanes)));

inline Lanes load(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline void store(double* to, Lanes lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}

inline Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}

inline Lanes square_root(Lanes x) {
  Lanes root;
  for (std::size_t i = 0; i < n_lanes; ++i) root[i] = __builtin_sqrt(x[i]);
  return root;
}

/// The largest of the lanes; halves are laid on each other.
inline double largest_of(Lanes lanes) {
  for (std::size_t half = n_lanes / 2; half > 0; half /= 2) {
    Indices other;
    for (std::size_t i = 0; i < n_lanes; ++i) other[i] = long(i + half) % long(n_lanes);
    lanes = larger(lanes, __builtin_shuffle(lanes, other));
  }
  return lanes[0];
}

/// Whether a comparison, all bits of a lane set where it holds, holds in any lane. Taking the lanes out one
/// by one costs more than what is decided here.
inline bool any(Indices mask) {
#if defined(__AVX512F__)
  using Bits = long long __attribute__((vector_size(64)));
  return __builtin_ia32_ptestmq512(Bits(mask), Bits(mask), 0xff) != 0;
#elif defined(__AVX__)
  return __builtin_ia32_movmskpd256(Lanes(mask)) != 0;
#else
  return (mask[0] | mask[1]) != 0;
#endif
}

/// A bit for each lane where a is at least b, the lowest for the first lane.
inline unsigned at_least(Lanes a, Lanes b) {
#if defined(__AVX512F__)
  constexpr int greater_or_equal = 29, rounding_of_now = 4;
  return __builtin_ia32_cmppd512_mask(a, b, greater_or_equal, 0xff, rounding_of_now);
#elif defined(__AVX__)
  return unsigned(__builtin_ia32_movmskpd256(Lanes(a >= b)));
#else
  return (a[0] >= b[0] ? 1u : 0u) | (a[1] >= b[1] ? 2u : 0u);
#endif
}

/// The first of equal values.
/// @tparam n_at_once  registers that are looked at together
/// @param n           a multiple of n_at_once * n_lanes
/// @param value       one of them; 0 is returned if it is not
template <std::size_t n_at_once>
inline long first_equal(const double* values, std::size_t n, double value) {
  for (std::size_t i = 0; i < n; i += n_at_once * n_lanes) {
    Indices equal = {};
#pragma GCC unroll 6
    for (std::size_t r = 0; r < n_at_once; ++r) equal |= load(values + i + r * n_lanes) == Lanes{} + value;
    if (any(equal))
      for (;; ++i)
        if (values[i] == value) return long(i);
  }
  return 0;
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
