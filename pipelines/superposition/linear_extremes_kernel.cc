/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superposition/linear_extremes_kernel.h"

#include "pipelines/superposition/lanes.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Forms times registers of instants: 24 sums fit the 32 registers of AVX-512, eight the sixteen of others.
constexpr std::size_t n_forms = n_lanes == 8 ? 8 : 4, n_groups = n_lanes == 8 ? 3 : 2;
static_assert(forms_at_once % n_forms == 0 && block % (n_groups * n_lanes) == 0);

/// Registers of values that are searched together.
constexpr std::size_t at_once = 3;
static_assert(block % (at_once * n_lanes) == 0);

/// Of each lane the extremes so far.
struct Range {
  Lanes largest = Lanes{} - __builtin_huge_val(), smallest = Lanes{} + __builtin_huge_val();
};

inline double smallest_of(Lanes lanes) {
  return -largest_of(-lanes);
}

/// A group of instants for some forms.
/// @param a       factors
/// @param values  of the first form at these instants
/// @param stride  from one form's values to the next's
inline void take(const double* weights, const double* a, std::size_t n_channels, double* values,
                 std::size_t stride, Range* ranges) {
  Lanes sum[n_forms][n_groups] = {};
  for (std::size_t k = 0; k < n_channels; ++k, a += block, weights += forms_at_once) {
    Lanes factor[n_groups];
#pragma GCC unroll 3
    for (std::size_t r = 0; r < n_groups; ++r) factor[r] = load(a + r * n_lanes);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < n_forms; ++i)
#pragma GCC unroll 3
      for (std::size_t r = 0; r < n_groups; ++r) sum[i][r] += weights[i] * factor[r];
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < n_forms; ++i)
#pragma GCC unroll 3
    for (std::size_t r = 0; r < n_groups; ++r) {
      ranges[i].largest = larger(sum[i][r], ranges[i].largest);
      ranges[i].smallest = smaller(sum[i][r], ranges[i].smallest);
      store(values + i * stride + r * n_lanes, sum[i][r]);
    }
}

}  // namespace

void linear_walk(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  const std::size_t n_channels = factors.n_channels, n_instants = factors.n_blocks * block;
  Range ranges[forms_at_once];
  for (std::size_t first = 0; first < n_instants; first += n_groups * n_lanes) {
    const double* a = factors.values + first / block * n_channels * block + first % block;
    for (std::size_t i = 0; i < forms_at_once; i += n_forms)
      take(weights + i, a, n_channels, room + i * n_instants + first, n_instants, ranges + i);
  }
  for (std::size_t i = 0; i < forms_at_once; ++i) {
    const double *values = room + i * n_instants, largest = largest_of(ranges[i].largest),
                 smallest = smallest_of(ranges[i].smallest);
    found[i] = {largest, smallest, first_equal<at_once>(values, n_instants, largest),
                first_equal<at_once>(values, n_instants, smallest)};
  }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
