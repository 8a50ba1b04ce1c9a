/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (pipelines/CMakeLists.txt). No
/// other header with inline code may be included here: the linker would keep one copy of it, for one
/// instruction set, for all callers.
#include "pipelines/superposition_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// One hardware register of doubles. A longer vector would be taken apart by the compiler, badly.
#if defined(__AVX512F__)
constexpr std::size_t n_lanes = 8;
#elif defined(__AVX__)
constexpr std::size_t n_lanes = 4;
#else
constexpr std::size_t n_lanes = 2;
#endif
using Lanes = double __attribute__((vector_size(8 * n_lanes)));
using Indices = long __attribute__((vector_size(8 * n_lanes)));

// Two registers of instants for six components: twelve accumulators fit the sixteen registers of AVX2.
constexpr std::size_t n_registers = 2, group = n_registers * n_lanes;
static_assert(block % group == 0);

struct Best {
  Lanes value[n_registers];
  Indices group[n_registers];
};

/// Keeps the quotient of an unstressed place from being 0/0; far below the cube of any stress that counts.
constexpr double smallest = 1e-280;

/// Not less than cos(acos(c) / 3) for c in [-1, 1], and at most 3 % above it. As a function of c it is
/// concave, so that each of its tangents lies above it; f is where the tangent touches, c = 4 f^3 - 3 f.
inline Lanes lode_bound(Lanes c) {
  Lanes least = Lanes{} + 1.0;
  constexpr double touches[] = {0.97, 0.88, 0.75, 0.62, 0.53}, round_off = 1e-12;
#pragma GCC unroll 5
  for (const double f : touches) {
    const Lanes tangent = (c - (4 * f * f * f - 3 * f)) * (1 / (12 * f * f - 3)) + (f + round_off);
    least = tangent < least ? tangent : least;
  }
  return least;
}

}  // namespace

void walk(const double* unit_stress, std::size_t n_nodes, std::size_t n_channels, const double* factors,
          std::size_t n_blocks, NodeMaximum* maximum, double* block_bound) {
  Best best[batch];
  for (std::size_t node = 0; node < n_nodes; ++node)
    for (std::size_t r = 0; r < n_registers; ++r) {
      best[node].value[r] = Lanes{} - 1.0;
      best[node].group[r] = Indices{};
    }
  for (std::size_t b = 0; b < n_blocks; ++b)
    for (std::size_t node = 0; node < n_nodes; ++node) {
      Lanes bound = Lanes{} - __builtin_huge_val();
      for (std::size_t g = 0; g < block / group; ++g) {
        const double* a = factors + b * n_channels * block + g * group;
        const double* unit = unit_stress + node * n_channels * 6;
        Lanes s[6][n_registers] = {};
        for (std::size_t k = 0; k < n_channels; ++k, a += block, unit += 6) {
          Lanes factor[n_registers];
#pragma GCC unroll 2
          for (std::size_t r = 0; r < n_registers; ++r)
            __builtin_memcpy(&factor[r], a + r * n_lanes, sizeof(Lanes));
#pragma GCC unroll 6
          for (int c = 0; c < 6; ++c)
#pragma GCC unroll 2
            for (std::size_t r = 0; r < n_registers; ++r) s[c][r] += unit[c] * factor[r];
        }
#pragma GCC unroll 2
        for (std::size_t r = 0; r < n_registers; ++r) {
          const Lanes mean = (s[0][r] + s[1][r] + s[2][r]) * (1.0 / 3.0);
          const Lanes dx = s[0][r] - mean, dy = s[1][r] - mean, dz = s[2][r] - mean;
          const Lanes q = 1.5 * (dx * dx + dy * dy + dz * dz) +
                          3.0 * (s[3][r] * s[3][r] + s[4][r] * s[4][r] + s[5][r] * s[5][r]);
          const auto larger = q > best[node].value[r];
          best[node].value[r] = larger ? q : best[node].value[r];
          best[node].group[r] = larger ? Indices{} + long(b * (block / group) + g) : best[node].group[r];
          Lanes root;
          for (std::size_t i = 0; i < n_lanes; ++i) root[i] = __builtin_sqrt(q[i]);
          const Lanes third = dx * (dy * dz - s[4][r] * s[4][r]) -
                              s[3][r] * (s[3][r] * dz - s[4][r] * s[5][r]) +
                              s[5][r] * (s[3][r] * s[4][r] - dy * s[5][r]);
          const Lanes sum = mean + 2.0 / 3.0 * root * lode_bound(13.5 * third / (q * root + smallest));
          bound = sum > bound ? sum : bound;
        }
      }
      double largest = bound[0];
      for (std::size_t i = 1; i < n_lanes; ++i) largest = bound[i] > largest ? bound[i] : largest;
      block_bound[node * n_blocks + b] = largest;
    }
  for (std::size_t node = 0; node < n_nodes; ++node) {
    maximum[node] = {-1, 0};
    for (std::size_t r = 0; r < n_registers; ++r)
      for (std::size_t i = 0; i < n_lanes; ++i) {
        const long instant = best[node].group[r][i] * long(group) + long(r * n_lanes + i);
        const double q = best[node].value[r][i];
        if (q > maximum[node].von_mises_squared ||
            (q == maximum[node].von_mises_squared && instant < maximum[node].instant))
          maximum[node] = {q, instant};
      }
  }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
