/// Stresses of several instants in registers, and the largest principal stress of a node; for the files that
/// are compiled once per instruction set (lanes.h).
#pragma once

#include "pipelines/superpose/kernels/lanes.h"
#include "pipelines/superpose/kernels/spans_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {

/// Coordinates of the stress over a group of instants.
/// @tparam n_of_it  5 for the deviator's, 6 with the mean stress
/// @tparam n        registers of instants
template <std::size_t n_of_it, std::size_t n>
struct Stresses {
  Lanes s[n_of_it][n];

  /// @param a  factors of the group's first instant
  [[gnu::always_inline]] Stresses(const double* unit, const double* a, std::size_t n_channels) : s{} {
    add_channels<n_coordinates>(unit, a, n_channels, s);
  }

  /// Squared von Mises stress.
  Lanes square(std::size_t r) const {
    Lanes sum = s[0][r] * s[0][r];
#pragma GCC unroll 4
    for (std::size_t c = 1; c < 5; ++c) sum += s[c][r] * s[c][r];
    return sum;
  }

  /// 27/2 of the deviator's determinant: sigma_v^3 times the cosine of three Lode angles.
  Lanes third_invariant(std::size_t r) const {
    constexpr double root_of_3 = 1.7320508075688772;
    const Lanes a = s[0][r], b = s[1][r], xy = s[2][r], yz = s[3][r], xz = s[4][r];
    return b * (3.0 * (a * a + xy * xy) - b * b - 1.5 * (yz * yz + xz * xz)) +
           root_of_3 * (3.0 * xy * yz * xz + 1.5 * a * (xz * xz - yz * yz));
  }

  Lanes mean(std::size_t r) const {
    static_assert(n_of_it == 6);
    return s[5][r];
  }
};

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

/// Largest principal stress: mean + 2/3 sigma_v cos(theta).
/// @param q      squared von Mises stress
/// @param third  Stresses::third_invariant
inline Lanes largest_principal(Lanes q, Lanes third, Lanes mean, const double* lode) {
  const Lanes root = square_root(q);
  return mean + 2.0 / 3.0 * root * lode_cosine(third / (q * root + smallest), lode);
}

/// More than rounding leaves of what is compared.
constexpr double tolerance = 1e-12;

/// Whether a largest principal stress may be `value` or more. With y = 3/2 (value - mean) it is where
/// y < sigma_v / 2, or 4 y^3 - 3 sigma_v^2 y < 27/2 det, since sigma_v cos(theta) is the largest root of that
/// cubic.
/// @return a bit for each lane
inline unsigned may_reach(Lanes value, Lanes q, Lanes third, Lanes mean) {
  const Lanes y = 1.5 * (value - mean), y_squared = 4.0 * (y * y);
  const Lanes cubic = y * (y_squared * (1 - tolerance) - q * (3 * (1 + tolerance)));
  return at_least(Lanes{}, y) | at_least(q * (1 + tolerance), y_squared) | at_least(third, cubic);
}

/// Looks for a larger principal stress in a group of instants. The angle is computed where one may be.
/// @param first  the group's first instant
template <std::size_t n>
[[gnu::always_inline]] inline void look_into(const Stresses<6, n>& stresses, std::size_t first,
                                             const double* lode, Largest& principal) {
  Lanes q[n], third[n];
  unsigned candidates = 0;
#pragma GCC unroll 4
  for (std::size_t r = 0; r < n; ++r) {
    q[r] = stresses.square(r);
    third[r] = stresses.third_invariant(r);
    candidates |= may_reach(Lanes{} + principal.value, q[r], third[r], stresses.mean(r));
  }
  if (candidates == 0) return;
  Lanes found[n];
  for (std::size_t r = 0; r < n; ++r) found[r] = largest_principal(q[r], third[r], stresses.mean(r), lode);
  principal.take(found, first);
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
