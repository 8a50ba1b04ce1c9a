/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superpose/kernels/knots_kernel.h"

#include "pipelines/superpose/kernels/principal_kernel.h"
#include "pipelines/superpose/kernels/spans_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Registers of knots for six coordinates: eighteen sums fit the 32 registers of AVX-512, twelve the sixteen
// of AVX2.
constexpr std::size_t n_of_knots = n_lanes == 8 ? 3 : 2;
static_assert(block % (n_of_knots * n_lanes) == 0);

/// What von Mises stress and the largest principal stress exceed those of the knots by.
class Deviations {
public:
  double* von_mises;
  double* principal;

  Deviations(const double* unit, const Factors& factors, double* room)
      : von_mises(room), principal(room + factors.knots.n_deviations), n_(factors.knots.n_deviations) {
    double* sizes = principal + n_;
    find_sizes(unit, factors.n_channels, sizes);
    for (std::size_t d = 0; d < n_; d += n_lanes) {
      Lanes of_von_mises = {}, of_principal = {};
      for (std::size_t k = 0; k < factors.n_channels; ++k) {
        const Lanes deviation = load(factors.knots.deviations + k * n_ + d);
        of_von_mises += sizes[2 * k] * deviation;
        of_principal += sizes[2 * k + 1] * deviation;
      }
      store(von_mises + d, of_von_mises);
      store(principal + d, of_principal);
    }
  }

  /// Squared von Mises stress from which on a knot's spans may have `largest`, instead of the deviations.
  void squares_that_reach(double largest) const {
    for (std::size_t d = 0; d < n_; d += n_lanes) {
      const Lanes rest = larger(largest - load(von_mises + d), Lanes{});
      store(von_mises + d, rest * rest * (1 - tolerance));
    }
  }

private:
  /// Sizes of each channel's unit stress: von Mises, and a bound of the largest principal stress with either
  /// sign.
  static void find_sizes(const double* unit, std::size_t n_channels, double* sizes) {
    for (std::size_t k = 0; k < n_channels; ++k, unit += n_coordinates) {
      double square = 0;
      for (std::size_t c = 0; c < 5; ++c) square += unit[c] * unit[c];
      sizes[2 * k] = __builtin_sqrt(square);
      sizes[2 * k + 1] = __builtin_fabs(unit[5]) + 2.0 / 3.0 * sizes[2 * k];
    }
  }

  std::size_t n_;
};

/// Squared von Mises stress, third invariant and mean stress at the knots of a node.
struct AtKnots {
  std::size_t n;
  double *squares, *thirds, *means;
  double largest_square;

  // Apart from the rest, here and in look_into_span, so that the sums stay in registers: 3 % of the time.
  [[gnu::noinline]] AtKnots(const double* unit, const Factors& factors, double* room)
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

  /// The largest principal stress of some knots: those where mean + sigma_v / 2 + sigma_v cos(3 theta) / 6,
  /// below it by a tenth of sigma_v at most, seems largest.
  Largest principal_so_far(const double* lode, const Knots& knots) const {
    const double size = __builtin_sqrt(largest_square), of_square = 0.5 / (size + smallest),
                 of_third = 1.0 / 6.0 / (largest_square + smallest);
    LargestOfLanes largest;
    for (std::size_t i = 0; i < n; i += n_lanes) {
      const Lanes estimate[] = {load(means + i) + of_square * load(squares + i) +
                                of_third * load(thirds + i)};
      largest.take(estimate, i);
    }
    const std::size_t at = std::size_t(largest.of_all().instant) / n_lanes * n_lanes;
    const Lanes found[] = {largest_principal(load(squares + at), load(thirds + at), load(means + at), lode)};
    Largest principal;
    principal.take(found, at);
    const std::size_t instant = std::size_t(principal.instant) * span;
    principal.instant = long(instant < knots.last ? instant : knots.last);
    return principal;
  }
};

/// The maxima of a node over spans of instants.
class Maxima {
public:
  LargestOfLanes square;
  Largest principal;
  std::size_t n_spans = 0;  ///< spans that were looked into

  /// @param so_far  principal stress of a knot. Should it come out smaller within its span, by rounding, the
  ///                knot stays.
  Maxima(const double* unit, const Factors& factors, const double* lode, const Largest& so_far)
      : principal(so_far), unit_(unit), factors_(factors), lode_(lode) {}

  [[gnu::noinline]] void look_into_span(std::size_t number) {
    const std::size_t first = number * span;
    ++n_spans;
    const Stresses<6, n_of_span> stresses(unit_, factors_at(factors_, first), factors_.n_channels);
    look_into(stresses, first, lode_, principal);
    Lanes squares[n_of_span];
#pragma GCC unroll 4
    for (std::size_t r = 0; r < n_of_span; ++r) squares[r] = stresses.square(r);
    square.take(squares, first);
  }

private:
  const double* unit_;
  const Factors& factors_;
  const double* lode_;
};

}  // namespace

NodeMaximum walk_knots(const double* unit, const Factors& factors, const double* lode, double* room) {
  const AtKnots at(unit, factors, room);
  const Deviations deviations(unit, factors, room + 3 * at.n);
  const double size = __builtin_sqrt(at.largest_square);
  deviations.squares_that_reach(size);
  Largest so_far = at.principal_so_far(lode, factors.knots);
  so_far.value -= tolerance * (size + __builtin_fabs(so_far.value));
  Maxima maxima(unit, factors, lode, so_far);
  const auto matter = [&](std::size_t knot) {
    const std::size_t d = knot / knots_at_once;
    const Lanes square = load(at.squares + knot),
                value = Lanes{} + (maxima.principal.value - deviations.principal[d]);
    return at_least(square, Lanes{} + deviations.von_mises[d]) |
           may_reach(value, square, load(at.thirds + knot), load(at.means + knot));
  };
  for_each_span(factors.knots, matter, [&](std::size_t number) { maxima.look_into_span(number); });
  const Largest square = maxima.square.of_all();
  const std::size_t n_with_six = factors.knots.n_spans + 1 + maxima.n_spans * (span - 1);
  return {square.value, maxima.principal.value, square.instant, maxima.principal.instant, 0, n_with_six};
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
