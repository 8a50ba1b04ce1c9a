/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (pipelines/CMakeLists.txt). No
/// other header with inline code may be included here: the linker would keep one copy of it, for one
/// instruction set, for all callers.
#include "pipelines/superposition/superposition_kernel.h"

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

/// Of each lane the largest value so far, and in which group of instants it was first.
struct Best {
  Lanes value[n_registers];
  Indices group[n_registers];

  void start(double below_all) {
    for (std::size_t r = 0; r < n_registers; ++r) {
      value[r] = Lanes{} + below_all;
      group[r] = Indices{};
    }
  }
  void take(std::size_t r, Lanes candidate, long of_group) {
    const auto larger = candidate > value[r];
    value[r] = larger ? candidate : value[r];
    group[r] = larger ? Indices{} + of_group : group[r];
  }
  void largest(double& largest, long& instant) const {
    largest = value[0][0];
    instant = instant_of(0, 0);
    for (std::size_t r = 0; r < n_registers; ++r)
      for (std::size_t i = 0; i < n_lanes; ++i)
        if (value[r][i] > largest || (value[r][i] == largest && instant_of(r, i) < instant)) {
          largest = value[r][i];
          instant = instant_of(r, i);
        }
  }

private:
  long instant_of(std::size_t r, std::size_t i) const {
    return group[r][i] * long(n_registers * n_lanes) + long(r * n_lanes + i);
  }
};

/// Keeps the quotient of an unstressed place from being 0/0; far below the cube of any stress that counts.
constexpr double smallest = 1e-280;

inline Lanes square_root(Lanes x) {
  Lanes root;
  for (std::size_t i = 0; i < n_lanes; ++i) root[i] = __builtin_sqrt(x[i]);
  return root;
}

/// cos(acos(c) / 3) for c in [-1, 1]; rounding may have left the interval.
inline Lanes lode_cosine(Lanes c, const double* term) {
  c = c > -1.0 ? c : Lanes{} - 1.0;
  c = c < 1.0 ? c : Lanes{} + 1.0;
  const Lanes t = 2.0 * square_root(0.5 + 0.5 * c) - 1.0, square = t * t;
  Lanes even = Lanes{} + term[n_lode_terms - 1], odd = Lanes{} + term[n_lode_terms - 2];
#pragma GCC unroll 8
  for (std::size_t k = n_lode_terms - 3; k > 1; k -= 2) {
    even = even * square + term[k];
    odd = odd * square + term[k - 1];
  }
  even = even * square + term[0];
  return even + t * odd;
}

/// Halves are laid on each other: taking the lanes out one by one costs more than what is decided here.
inline bool any(Indices mask) {
  for (std::size_t half = n_lanes / 2; half > 0; half /= 2) {
    Indices other;
    for (std::size_t i = 0; i < n_lanes; ++i) other[i] = long(i + half) % long(n_lanes);
    mask |= __builtin_shuffle(mask, other);
  }
  return mask[0] != 0;
}

/// (2/3)^2, and more than rounding and the polynomial leave: cos(theta) is at most 1.
constexpr double reach_squared = 4.0 / 9.0 * (1 + 1e-12);

}  // namespace

void walk(const double* unit_stress, std::size_t n_nodes, std::size_t n_channels, const double* factors,
          std::size_t n_blocks, const double* lode, NodeMaximum* maximum) {
  Best von_mises[batch], principal[batch];
  for (std::size_t node = 0; node < n_nodes; ++node) {
    von_mises[node].start(-1);
    principal[node].start(-__builtin_huge_val());
  }
  for (std::size_t b = 0; b < n_blocks; ++b)
    for (std::size_t node = 0; node < n_nodes; ++node)
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
          const long of_group = long(b * (block / group) + g);
          von_mises[node].take(r, q, of_group);
          // The principal stress is dear; where mean + 2/3 sigma_v is not above the largest so far, it is
          // not.
          const Lanes above = principal[node].value[r] - mean;
          if (!any((above < 0.0) | (reach_squared * q > above * above))) continue;
          const Lanes root = square_root(q);
          const Lanes third = dx * (dy * dz - s[4][r] * s[4][r]) -
                              s[3][r] * (s[3][r] * dz - s[4][r] * s[5][r]) +
                              s[5][r] * (s[3][r] * s[4][r] - dy * s[5][r]);
          const Lanes cosine = lode_cosine(13.5 * third / (q * root + smallest), lode);
          principal[node].take(r, mean + 2.0 / 3.0 * root * cosine, of_group);
        }
      }
  for (std::size_t node = 0; node < n_nodes; ++node) {
    von_mises[node].largest(maximum[node].von_mises_squared, maximum[node].von_mises_instant);
    principal[node].largest(maximum[node].principal, maximum[node].principal_instant);
  }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
