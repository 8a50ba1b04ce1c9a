/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superposition/linear_extremes_kernel.h"

#include "pipelines/superposition/spans_kernel.h"

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

/// The forms at all instants of a table of factors.
/// @param factors  n_blocks x n_channels x block
/// @param values   forms_at_once x n_blocks x block, to be written
/// @param ranges   forms_at_once, to be widened
void superpose(const double* weights, const double* factors, std::size_t n_channels, std::size_t n_blocks,
               double* values, Range* ranges) {
  const std::size_t n = n_blocks * block;
  for (std::size_t first = 0; first < n; first += n_groups * n_lanes) {
    const double* a = factors + first / block * n_channels * block + first % block;
    for (std::size_t i = 0; i < forms_at_once; i += n_forms)
      take(weights + i, a, n_channels, values + i * n + first, n, ranges + i);
  }
}

void walk_all_instants(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  const std::size_t n = factors.n_blocks * block;
  Range ranges[forms_at_once];
  superpose(weights, factors.values, factors.n_channels, factors.n_blocks, room, ranges);
  for (std::size_t i = 0; i < forms_at_once; ++i, room += n) {
    const double largest = largest_of(ranges[i].largest), smallest = smallest_of(ranges[i].smallest);
    found[i] = {largest, smallest, first_equal<at_once>(room, n, largest),
                first_equal<at_once>(room, n, smallest)};
  }
}

/// By how much a form exceeds the values at its knots.
/// @param weight      the form's first weight
/// @param deviations  knots.n_deviations, to be written
void find_deviations(const double* weight, const Factors& factors, double* deviations) {
  for (std::size_t d = 0; d < factors.knots.n_deviations; d += n_lanes) {
    Lanes sum = {};
    for (std::size_t k = 0; k < factors.n_channels; ++k)
      sum += __builtin_fabs(weight[k * forms_at_once]) *
             load(factors.knots.deviations + k * factors.knots.n_deviations + d);
    store(deviations + d, sum);
  }
}

/// Looks into the spans where a form may have its extremes.
/// @param weight      the form's first weight
/// @param values      at the knots
/// @param deviations  as find_deviations()
LinearExtremes extremes_near_knots(const double* weight, const Factors& factors, const Range& range,
                                   const double* values, const double* deviations) {
  const double most = largest_of(range.largest), least = smallest_of(range.smallest);
  Largest largest, negative;
  const auto matter = [&](std::size_t knot) {
    const Lanes value = load(values + knot), deviation = Lanes{} + deviations[knot / knots_at_once];
    return (value + deviation >= Lanes{} + most) | (value - deviation <= Lanes{} + least);
  };
  for_each_span(factors.knots, matter, [&](std::size_t number) {
    for (std::size_t i = 0; i < span; i += n_of_span * n_lanes) {
      const double* a = factors_at(factors, number * span + i);
      Lanes sum[n_of_span] = {}, opposite[n_of_span];
      for (std::size_t k = 0; k < factors.n_channels; ++k, a += block)
        for (std::size_t r = 0; r < n_of_span; ++r)
          sum[r] += weight[k * forms_at_once] * load(a + r * n_lanes);
      for (std::size_t r = 0; r < n_of_span; ++r) opposite[r] = -sum[r];
      largest.take(sum, number * span + i);
      negative.take(opposite, number * span + i);
    }
  });
  return {largest.value, -negative.value, largest.instant, negative.instant};
}

void walk_knots(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  const std::size_t n = factors.knots.n_blocks * block;
  Range ranges[forms_at_once];
  superpose(weights, factors.knots.values, factors.n_channels, factors.knots.n_blocks, room, ranges);
  double* deviations = room + forms_at_once * n;
  for (std::size_t i = 0; i < forms_at_once; ++i) {
    find_deviations(weights + i, factors, deviations);
    found[i] = extremes_near_knots(weights + i, factors, ranges[i], room + i * n, deviations);
  }
}

}  // namespace

void linear_walk(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  if (factors.knots.n_spans == 0) return walk_all_instants(weights, factors, room, found);
  walk_knots(weights, factors, room, found);
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
