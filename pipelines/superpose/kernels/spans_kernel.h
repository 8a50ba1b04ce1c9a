/// Maxima over spans of instants; for the files that are compiled once per instruction set (lanes.h).
#pragma once

#include "pipelines/superpose/kernels/lanes.h"
#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {

/// Registers of a span.
constexpr std::size_t n_of_span = span / n_lanes;
static_assert(span % n_lanes == 0 && block % span == 0 && knots_at_once % n_lanes == 0);

/// Keeps the quotient of what is zero from being 0/0; far below the cube of any stress that counts.
constexpr double smallest = 1e-280;

/// The largest of some values, and the first instant that has it, in whatever order they come.
struct Largest {
  double value = -__builtin_huge_val();
  long instant = 0;

  /// @param first  the first value's instant
  template <std::size_t n>
  [[gnu::always_inline]] void take(const Lanes (&values)[n], std::size_t first) {
    Lanes most = values[0];
#pragma GCC unroll 3
    for (std::size_t r = 1; r < n; ++r) most = larger(values[r], most);
    if (at_least(most, Lanes{} + value) == 0) return;
    const double largest = largest_of(most);
    for (std::size_t r = 0; r < n; ++r)
      if (const unsigned bits = at_least(values[r], Lanes{} + largest); bits != 0) {
        const long at = long(first + r * n_lanes) + __builtin_ctz(bits);
        if (largest > value || at < instant) instant = at;
        break;
      }
    value = largest;
  }
};

/// The same in each lane, of values in the order of their instants.
class LargestOfLanes {
public:
  LargestOfLanes() {
    for (std::size_t i = 0; i < n_lanes; ++i) lane_[i] = long(i);
  }

  /// @param first  the first value's instant
  template <std::size_t n>
  [[gnu::always_inline]] void take(const Lanes (&values)[n], std::size_t first) {
#pragma GCC unroll 4
    for (std::size_t r = 0; r < n; ++r) {
      instants_ = values[r] > values_ ? lane_ + long(first + r * n_lanes) : instants_;
      values_ = larger(values[r], values_);
    }
  }

  Largest of_all() const {
    Largest largest{largest_of(values_), __LONG_MAX__};
    long instants[n_lanes];
    __builtin_memcpy(instants, &instants_, sizeof instants);
    for (unsigned bits = at_least(values_, Lanes{} + largest.value); bits != 0; bits &= bits - 1)
      if (const long at = instants[__builtin_ctz(bits)]; at < largest.instant) largest.instant = at;
    return largest;
  }

private:
  Lanes values_ = Lanes{} - __builtin_huge_val();
  Indices instants_ = {}, lane_;
};

/// Factors of the first channel at an instant, and of the others each `block` further.
inline const double* factors_at(const Factors& factors, std::size_t instant) {
  return factors.values + instant / block * factors.n_channels * block + instant % block;
}

/// Adds the channels up at a group of instants.
/// @tparam stride   from one channel's numbers to the next one's
/// @param numbers  numbers of the first channel: one for each sum
/// @param a        factors of the first channel at the group's first instant
template <std::size_t stride, std::size_t n_sums, std::size_t n>
[[gnu::always_inline]] inline void add_channels(const double* numbers, const double* a,
                                                std::size_t n_channels, Lanes (&sum)[n_sums][n]) {
  for (std::size_t k = 0; k < n_channels; ++k, a += block, numbers += stride) {
    Lanes factor[n];
#pragma GCC unroll 4
    for (std::size_t r = 0; r < n; ++r) factor[r] = load(a + r * n_lanes);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < n_sums; ++i)
#pragma GCC unroll 4
      for (std::size_t r = 0; r < n; ++r) sum[i][r] += numbers[i] * factor[r];
  }
}

/// Bits of as many lanes as a word has. What follows from them branches once for each, not for each register.
/// @param of_lanes  gives for a number the bits of n_lanes lanes from it on
/// @param n         only lanes below it count
template <typename OfLanes>
[[gnu::always_inline]] inline unsigned long word_of(const OfLanes& of_lanes, std::size_t first,
                                                    std::size_t n) {
  unsigned long word = 0;
  const std::size_t n_of_word = n - first < 64 ? n - first : 64;
  for (std::size_t i = 0; i < n_of_word; i += n_lanes) word |= (unsigned long)(of_lanes(first + i)) << i;
  return n_of_word < 64 ? word & ((1ul << n_of_word) - 1) : word;
}

/// The spans beside knots that matter, in ascending order.
/// @param matter  gives for the number of a knot a bit for each of n_lanes knots from it on
/// @param look    takes the number of a span
template <typename Matter, typename Look>
[[gnu::always_inline]] inline void for_each_span(const Knots& knots, const Matter& matter, const Look& look) {
  const std::size_t n_knots = knots.n_spans + 1;
  unsigned long next = word_of(matter, 0, n_knots);
  for (std::size_t first = 0; first < knots.n_spans; first += 64) {
    const unsigned long here = next;
    next = first + 64 < n_knots ? word_of(matter, first + 64, n_knots) : 0;
    unsigned long spans = here | here >> 1 | next << 63;
    if (knots.n_spans - first < 64) spans &= (1ul << (knots.n_spans - first)) - 1;
    for (; spans != 0; spans &= spans - 1) look(first + std::size_t(__builtin_ctzl(spans)));
  }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
