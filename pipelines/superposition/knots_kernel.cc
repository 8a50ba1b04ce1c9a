/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superposition/knots_kernel.h"

#include "pipelines/superposition/principal_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Registers of knots for six coordinates: eighteen sums fit the 32 registers of AVX-512, twelve the sixteen
// of AVX2.
constexpr std::size_t n_of_knots = n_lanes == 8 ? 3 : 2;
static_assert(block % (n_of_knots * n_lanes) == 0);

/// What von Mises stress and the largest principal stress exceed those of the knots by.
struct Deviations {
  double* von_mises;
  double* principal;

  Deviations(const double* unit, const Factors& factors, double* room)
      : von_mises(room), principal(room + factors.knots.n_deviations) {
    for (std::size_t d = 0; d < factors.knots.n_deviations; d += n_lanes) {
      store(von_mises + d, Lanes{});
      store(principal + d, Lanes{});
    }
    const double* deviations = factors.knots.deviations;
    for (std::size_t k = 0; k < factors.n_channels; ++k, unit += n_coordinates) {
      double square = 0;
      for (std::size_t c = 0; c < 5; ++c) square += unit[c] * unit[c];
      const double size = __builtin_sqrt(square), of_principal = __builtin_fabs(unit[5]) + 2.0 / 3.0 * size;
      for (std::size_t d = 0; d < factors.knots.n_deviations; d += n_lanes, deviations += n_lanes) {
        store(von_mises + d, load(von_mises + d) + size * load(deviations));
        store(principal + d, load(principal + d) + of_principal * load(deviations));
      }
    }
  }
};

/// Squared von Mises stress, third invariant and mean stress at the knots of a node.
struct AtKnots {
  std::size_t n;
  double *squares, *thirds, *means;
  double largest_square;

  AtKnots(const double* unit, const Factors& factors, double* room)
      : n(factors.knots.n_blocks * block), squares(room), thirds(room + n), means(room + 2 * n) {
    Lanes most = {};
    for (std::size_t first = 0; first < n; first += n_of_knots * n_lanes) {
      const Stresses<6, n_of_knots> stresses(
          unit, factors.knots.values + first / block * factors.n_channels * block + first % block,
          factors.n_channels);
#pragma GCC unroll 3
      for (std::size_t r = 0; r < n_of_knots; ++r) {
        const Lanes square = stresses.square(r);
        most = larger(square, most);
        store(squares + first + r * n_lanes, square);
        store(thirds + first + r * n_lanes, stresses.third_invariant(r));
        store(means + first + r * n_lanes, stresses.mean(r));
      }
    }
    largest_square = largest_of(most);
  }

  /// A lower bound of the largest principal stress: that of the knots where mean + sigma_v / 2 + sigma_v
  /// cos(3 theta) / 6, below it by a tenth of sigma_v at most, seems largest.
  double principal_so_far(const double* lode) const {
    const double size = __builtin_sqrt(largest_square), of_square = 0.5 / (size + smallest),
                 of_third = 1.0 / 6.0 / (largest_square + smallest);
    const auto estimate = [&](std::size_t i) {
      return load(means + i) + of_square * load(squares + i) + of_third * load(thirds + i);
    };
    Lanes most = estimate(0);
    for (std::size_t i = n_lanes; i < n; i += n_lanes) most = larger(estimate(i), most);
    const Lanes largest = Lanes{} + largest_of(most);
    std::size_t at = 0;
    while (at + n_lanes < n && !any(estimate(at) == largest)) at += n_lanes;
    return largest_of(largest_principal(load(squares + at), load(thirds + at), load(means + at), lode));
  }
};

/// The maxima of a node over spans of instants.
class Maxima {
public:
  Largest square, principal;

  Maxima(const double* unit, const Factors& factors, const double* lode)
      : unit_(unit), factors_(factors), lode_(lode) {}

  void look_into_span(std::size_t number) {
    for (std::size_t i = 0; i < span; i += n_of_span * n_lanes) {
      const std::size_t first = number * span + i;
      const Stresses<6, n_of_span> stresses(unit_, factors_at(factors_, first), factors_.n_channels);
      look_into(stresses, first, lode_, principal);
      Lanes squares[n_of_span];
      for (std::size_t r = 0; r < n_of_span; ++r) squares[r] = stresses.square(r);
      square.take(squares, first);
    }
  }

private:
  const double* unit_;
  const Factors& factors_;
  const double* lode_;
};

}  // namespace

NodeMaximum walk_knots(const double* unit, const Factors& factors, const double* lode, double* room) {
  const Knots& knots = factors.knots;
  const Deviations deviations(unit, factors, room);
  const AtKnots at(unit, factors, room + 2 * knots.n_deviations);
  Maxima maxima(unit, factors, lode);
  maxima.square.value = at.largest_square * (1 - tolerance);
  const double size = __builtin_sqrt(at.largest_square);
  maxima.principal.value = at.principal_so_far(lode);
  maxima.principal.value -= tolerance * (size + __builtin_fabs(maxima.principal.value));
  const auto matter = [&](std::size_t knot) {
    const std::size_t d = knot / knots_at_once;
    const Lanes square = load(at.squares + knot);
    const double rest = __builtin_sqrt(maxima.square.value) - deviations.von_mises[d];
    const Lanes least = Lanes{} + (rest > 0 ? rest * rest * (1 - tolerance) : 0.0);
    return (square >= least) | may_reach(Lanes{} + (maxima.principal.value - deviations.principal[d]), square,
                                         load(at.thirds + knot), load(at.means + knot));
  };
  for_each_span(knots, matter, [&](std::size_t number) { maxima.look_into_span(number); });
  return {maxima.square.value, maxima.principal.value, maxima.square.instant, maxima.principal.instant};
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
