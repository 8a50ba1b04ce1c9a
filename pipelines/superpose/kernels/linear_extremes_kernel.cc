/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superpose/kernels/linear_extremes_kernel.h"

#include "pipelines/superpose/kernels/spans_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Forms times registers of instants: 24 sums fit the 32 registers of AVX-512, eight the sixteen of others.
constexpr std::size_t n_forms = n_lanes == 8 ? 8 : 4, n_groups = n_lanes == 8 ? 3 : 2;
static_assert(forms_at_once % n_forms == 0 && block % (n_groups * n_lanes) == 0);

/// Registers of values that are searched together.
constexpr std::size_t at_once = 3;
static_assert(block % (at_once * n_lanes) == 0);

/// Spans that are superposed side by side, so that one sum does not wait for another.
constexpr std::size_t n_beside = n_lanes == 8 ? 4 : n_lanes == 4 ? 2 : 1;

/// Extremes of each lane so far.
struct Range {
  Lanes largest = Lanes{} - __builtin_huge_val(), smallest = Lanes{} + __builtin_huge_val();
};

inline double smallest_of(Lanes lanes) {
  return -largest_of(-lanes);
}

/// A group of instants for some forms.
/// @param a       factors
/// @param values  values of the first form at these instants
/// @param stride  from one form's values to the next's
inline void take(const double* weights, const double* a, std::size_t n_channels, double* values,
                 std::size_t stride, Range* ranges) {
  Lanes sum[n_forms][n_groups] = {};
  add_channels<forms_at_once>(weights, a, n_channels, sum);
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

template <Wanted wanted>
void walk_all_instants(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  const std::size_t n = factors.n_blocks * block;
  Range ranges[forms_at_once];
  superpose(weights, factors.values, factors.n_channels, factors.n_blocks, room, ranges);
  for (std::size_t i = 0; i < forms_at_once; ++i, room += n) {
    found[i].smallest = smallest_of(ranges[i].smallest);
    found[i].smallest_instant = first_equal<at_once>(room, n, found[i].smallest);
    if constexpr (wanted == Wanted::both) {
      found[i].largest = largest_of(ranges[i].largest);
      found[i].largest_instant = first_equal<at_once>(room, n, found[i].largest);
    }
  }
}

/// How far the forms may lie from straight lines between their knots, as the factors' deviations.
/// @param deviations  forms_at_once x knots.n_deviations, to be written
void find_deviations(const double* weights, const Factors& factors, double* deviations) {
  const std::size_t n = factors.knots.n_deviations;
  for (std::size_t d = 0; d < n; d += n_lanes) {
    Lanes sums[forms_at_once] = {};
    for (std::size_t k = 0; k < factors.n_channels; ++k) {
      const Lanes deviation = load(factors.knots.deviations + k * n + d);
#pragma GCC unroll 8
      for (std::size_t i = 0; i < forms_at_once; ++i)
        sums[i] += __builtin_fabs(weights[k * forms_at_once + i]) * deviation;
    }
#pragma GCC unroll 8
    for (std::size_t i = 0; i < forms_at_once; ++i) store(deviations + i * n + d, sums[i]);
  }
}

/// The extremes of a form from its values at the knots.
template <Wanted wanted>
class NearKnots {
public:
  LargestOfLanes largest, negative;

  /// @param weight      the form's first weight
  /// @param values      at the knots
  /// @param deviations  deviations of the form
  NearKnots(const double* weight, const Factors& factors, const Range& range, const double* values,
            const double* deviations)
      : weight_(weight),
        factors_(factors),
        values_(values),
        deviations_(deviations),
        rounding_(deviations[factors.knots.n_deviations - 1]),
        most_(largest_of(range.largest) - rounding_),
        least_(smallest_of(range.smallest) + rounding_) {}

  void look() {
    const std::size_t n_spans = factors_.knots.n_spans;
    const auto matter = [this](std::size_t i) { return spans_that_matter(i); };
    std::size_t numbers[n_beside], n = 0;
    for (std::size_t first = 0; first < n_spans; first += 64)
      for (unsigned long spans = word_of(matter, first, n_spans); spans != 0; spans &= spans - 1) {
        numbers[n++] = first + std::size_t(__builtin_ctzl(spans));
        if (n < n_beside) continue;
        look_into_spans(numbers);
        n = 0;
      }
    if (n == 0) return;
    for (std::size_t j = n; j < n_beside; ++j) numbers[j] = numbers[n - 1];  // again
    look_into_spans(numbers);
  }

private:
  /// Spans that may hold an extreme. Between values a and b a form deviates from the line by 4 t (1 - t) of
  /// its deviation at most, 0 <= t <= 1: it is above the larger one by deviation - |b - a| / 4 at most, where
  /// that is positive.
  unsigned spans_that_matter(std::size_t i) const {
    const Lanes a = load(values_ + i), b = load(values_ + i + 1), most = larger(a, b), least = smaller(a, b);
    const Lanes more = larger(deviations_[i / knots_at_once] - 0.25 * (most - least), Lanes{});
    const unsigned low = at_least(Lanes{} + least_, least - more);
    return wanted == Wanted::both ? low | at_least(most + more, Lanes{} + most_) : low;
  }

  void look_into_spans(const std::size_t (&numbers)[n_beside]) {
    const double* a[n_beside];
    for (std::size_t j = 0; j < n_beside; ++j) a[j] = factors_at(factors_, numbers[j] * span);
    Lanes sums[n_beside][n_of_span] = {};
    for (std::size_t k = 0; k < factors_.n_channels; ++k)
#pragma GCC unroll 4
      for (std::size_t j = 0; j < n_beside; ++j)
#pragma GCC unroll 4
        for (std::size_t r = 0; r < n_of_span; ++r)
          sums[j][r] += weight_[k * forms_at_once] * load(a[j] + k * block + r * n_lanes);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n_beside; ++j) take(sums[j], numbers[j] * span);
  }

  void take(Lanes (&values)[n_of_span], std::size_t first) {
    if constexpr (wanted == Wanted::both) largest.take(values, first);
#pragma GCC unroll 4
    for (std::size_t r = 0; r < n_of_span; ++r) values[r] = -values[r];
    negative.take(values, first);
  }

  const double* weight_;
  const Factors& factors_;
  const double *values_, *deviations_;
  double rounding_, most_, least_;
};

template <Wanted wanted>
void walk_spans(const double* weights, const Factors& factors, double* room, LinearExtremes* found) {
  const std::size_t n = factors.knots.n_blocks * block;
  Range ranges[forms_at_once];
  superpose(weights, factors.knots.values, factors.n_channels, factors.knots.n_blocks, room, ranges);
  double* deviations = room + forms_at_once * n;
  find_deviations(weights, factors, deviations);
  for (std::size_t i = 0; i < forms_at_once; ++i) {
    NearKnots<wanted> form(weights + i, factors, ranges[i], room + i * n,
                           deviations + i * factors.knots.n_deviations);
    form.look();
    const Largest negative = form.negative.of_all();
    found[i].smallest = -negative.value;
    found[i].smallest_instant = negative.instant;
    if constexpr (wanted == Wanted::both) {
      const Largest largest = form.largest.of_all();
      found[i].largest = largest.value;
      found[i].largest_instant = largest.instant;
    }
  }
}

}  // namespace

void linear_walk(const double* weights, const Factors& factors, Wanted wanted, double* room,
                 LinearExtremes* found) {
  const bool has_knots = factors.knots.n_spans > 0;
  if (wanted == Wanted::both)
    (has_knots ? walk_spans<Wanted::both> : walk_all_instants<Wanted::both>)(weights, factors, room, found);
  else
    (has_knots ? walk_spans<Wanted::smallest> : walk_all_instants<Wanted::smallest>)(weights, factors, room,
                                                                                     found);
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
