/// Maxima over spans of instants; for the files that are compiled once per instruction set (lanes.h).
#pragma once

#include "pipelines/superposition/lanes.h"
#include "pipelines/superposition/superposition_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {

/// Registers in which a span is superposed.
constexpr std::size_t n_of_span = n_lanes == 8 ? 1 : 2;
static_assert(span % (n_of_span * n_lanes) == 0 && block % span == 0 && knots_at_once % n_lanes == 0);

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
  [[gnu::always_inline]] void take(Lanes values, std::size_t first) {
    instants_ = values > values_ ? lane_ + long(first) : instants_;
    values_ = larger(values, values_);
  }

  Largest of_all() const {
    Largest largest{largest_of(values_), __LONG_MAX__};
    for (std::size_t i = 0; i < n_lanes; ++i)
      if (values_[i] == largest.value && instants_[i] < largest.instant) largest.instant = instants_[i];
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

/// The spans beside knots that matter, in ascending order.
/// @param matter  of the number of a knot: which of n_lanes knots from it on matter, a bit each
/// @param look    takes the number of a span
template <typename Matter, typename Look>
[[gnu::always_inline]] inline void for_each_span(const Knots& knots, const Matter& matter, const Look& look) {
  std::size_t next = 0;  // the first one that may still come
  for (std::size_t i = 0; i <= knots.n_spans; i += n_lanes)
    for (unsigned bits = matter(i); bits != 0; bits &= bits - 1) {
      const std::size_t knot = i + std::size_t(__builtin_ctz(bits));
      for (std::size_t s = knot > next ? knot - 1 : next; s <= knot && s < knots.n_spans; ++s) look(s);
      next = knot + 1;
    }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
