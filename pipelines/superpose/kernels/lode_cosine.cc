#include "pipelines/superpose/kernels/lode_cosine.h"

#include <cmath>

#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

/// cos(acos(c) / 3) = cos(2/3 acos(s)) with s = sqrt((1 + c) / 2) is analytic but at s = -1: its Chebyshev
/// series over s in [0, 1], t = 2 s - 1, falls by six with each term and is 1e-15 exact; in powers of t,
/// whose coefficients fall as well, nothing cancels.
std::array<double, kernel::n_lode_terms> lode_polynomial() {
  constexpr std::size_t n = kernel::n_lode_terms, n_points = 64;
  std::array<double, n> powers{}, before{}, chebyshev{};  // coefficients of T_(k-1) and of T_k
  chebyshev[0] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    double coefficient = 0;
    for (std::size_t j = 0; j < n_points; ++j) {
      const double angle = pi * (double(j) + 0.5) / double(n_points);
      coefficient +=
          std::cos(2.0 / 3.0 * std::acos(0.5 + 0.5 * std::cos(angle))) * std::cos(double(k) * angle);
    }
    coefficient *= (k == 0 ? 1.0 : 2.0) / double(n_points);
    std::array<double, n> next{};  // T_(k+1) = 2 t T_k - T_(k-1), T_1 = t
    for (std::size_t i = 0; i < n; ++i) {
      powers[i] += coefficient * chebyshev[i];
      next[i] = (i > 0 ? (k == 0 ? 1.0 : 2.0) * chebyshev[i - 1] : 0.0) - before[i];
    }
    before = chebyshev;
    chebyshev = next;
  }
  return powers;
}

}  // namespace

const std::array<double, kernel::n_lode_terms>& lode_terms() {
  static const auto terms = lode_polynomial();
  return terms;
}

double lode_cosine(double c) {
  const auto& term = lode_terms();
  const double t = 2 * std::sqrt(0.5 + 0.5 * c) - 1, square = t * t;
  double even = term[kernel::n_lode_terms - 1], odd = term[kernel::n_lode_terms - 2];
  for (std::size_t k = kernel::n_lode_terms - 3; k > 1; k -= 2) {
    even = even * square + term[k];
    odd = odd * square + term[k - 1];
  }
  return even * square + term[0] + t * odd;
}

}  // namespace pipelines
