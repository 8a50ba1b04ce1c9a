/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superposition/superposition_kernel.h"

#include "pipelines/superposition/lanes.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Registers of instants for five coordinates: fifteen sums fit the 32 registers of AVX-512, ten the sixteen
// of others.
constexpr std::size_t n_registers = n_lanes == 8 ? 3 : 2, group = n_registers * n_lanes;
static_assert(block % group == 0 && blocks_at_once % n_lanes == 0);

/// Coordinates of the stress over a group of instants.
/// @tparam n_of_it  5 for the deviator's, 6 with the mean stress
template <std::size_t n_of_it>
struct Stresses {
  Lanes s[n_of_it][n_registers];

  [[gnu::always_inline]] Stresses(const double* unit, const double* a, std::size_t n_channels) : s{} {
    for (std::size_t k = 0; k < n_channels; ++k, a += block, unit += n_coordinates) {
      Lanes factor[n_registers];
#pragma GCC unroll 3
      for (std::size_t r = 0; r < n_registers; ++r) factor[r] = load(a + r * n_lanes);
#pragma GCC unroll 6
      for (std::size_t c = 0; c < n_of_it; ++c)
#pragma GCC unroll 3
        for (std::size_t r = 0; r < n_registers; ++r) s[c][r] += unit[c] * factor[r];
    }
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

/// More than rounding leaves of what is compared.
constexpr double tolerance = 1e-12;

/// The largest principal stress of a node so far.
class Principal {
public:
  double value = -__builtin_huge_val();
  long instant = 0;

  explicit Principal(const double* lode) : lode_(lode) {}

  /// The squared von Mises stress from which on instants matter whose mean stress is at most this.
  double threshold(double mean) const {
    const double rest = 1.5 * (value - mean);
    return rest > 0 ? rest * rest * (1 - tolerance) : -1;
  }

  /// @param first  the group's first instant
  void look_into(const Stresses<6>& stresses, std::size_t first) {
    Lanes q[n_registers], third[n_registers];
    Indices candidates = {};
#pragma GCC unroll 3
    for (std::size_t r = 0; r < n_registers; ++r) {
      q[r] = stresses.square(r);
      third[r] = stresses.third_invariant(r);
      candidates |= may_be_larger(q[r], third[r], stresses.s[5][r]);
    }
    if (!any(candidates)) return;
    double found[group];
    Lanes most;
    for (std::size_t r = 0; r < n_registers; ++r) {
      const Lanes root = square_root(q[r]), cosine = lode_cosine(third[r] / (q[r] * root + smallest), lode_);
      const Lanes stress = stresses.s[5][r] + 2.0 / 3.0 * root * cosine;
      store(found + r * n_lanes, stress);
      most = r == 0 ? stress : larger(stress, most);
    }
    take(largest_of(most), found, first);
  }

private:
  /// With y = 3/2 (value - mean) a stress is larger where y < sigma_v / 2, or 4 y^3 - 3 sigma_v^2 y < 27/2
  /// det, since sigma_v cos(theta) is the largest root of that cubic.
  Indices may_be_larger(Lanes q, Lanes third, Lanes mean) const {
    const Lanes y = 1.5 * (value - mean), y_squared = 4.0 * (y * y);
    const Lanes cubic = y * (y_squared * (1 - tolerance) - q * (3 * (1 + tolerance)));
    return (y < 0.0) | (y_squared <= q * (1 + tolerance)) | (cubic <= third);
  }

  void take(double largest, const double* found, std::size_t first) {
    if (!(largest >= value)) return;
    const long at = long(first) + first_equal<n_registers>(found, group, largest);
    if (largest > value || at < instant) instant = at;
    value = largest;
  }

  const double* lode_;
};

/// Upper bounds of a node's mean stress in each block.
void bound_means(const double* unit, const Factors& factors, double* bounds) {
  constexpr std::size_t n = blocks_at_once / n_lanes;
  for (std::size_t b = 0; b < factors.n_bounds; b += blocks_at_once) {
    Lanes middle[n] = {}, reach[n] = {};
    const double* of_channel = factors.bounds + 2 * b;
    for (std::size_t k = 0; k < factors.n_channels; ++k, of_channel += 2 * factors.n_bounds) {
      const double mean = unit[k * n_coordinates + 5], size = __builtin_fabs(mean);
#pragma GCC unroll 8
      for (std::size_t r = 0; r < n; ++r) {
        middle[r] += mean * load(of_channel + r * n_lanes);
        reach[r] += size * load(of_channel + blocks_at_once + r * n_lanes);
      }
    }
    for (std::size_t r = 0; r < n; ++r) store(bounds + b + r * n_lanes, middle[r] + reach[r]);
  }
}

/// The block of the largest of the squares, the first of equal ones.
/// @param peaks  n_blocks x n_lanes
std::size_t block_of_largest(const double* peaks, std::size_t n_blocks) {
  Lanes most = load(peaks);
  for (std::size_t b = 1; b < n_blocks; ++b) most = larger(load(peaks + b * n_lanes), most);
  const Lanes largest = Lanes{} + largest_of(most);
  for (std::size_t b = 0; b < n_blocks; ++b)
    if (any(load(peaks + b * n_lanes) == largest)) return b;
  return 0;
}

/// A node in one batch of nodes.
struct Node {
  const double* unit;  ///< n_channels x n_coordinates
  double* peaks;       ///< n_blocks x n_lanes: the largest squares of each lane in the block
};

void find_peaks(const Node& node, const double* a, std::size_t n_channels, std::size_t b) {
  Lanes peak = {};
  for (std::size_t g = 0; g < block; g += group) {
    const Stresses<5> stresses(node.unit, a + g, n_channels);
#pragma GCC unroll 3
    for (std::size_t r = 0; r < n_registers; ++r) peak = larger(stresses.square(r), peak);
  }
  store(node.peaks + b * n_lanes, peak);
}

/// Looks again into the block of the largest von Mises stress, and into those that may have the largest
/// principal stress.
NodeMaximum find_maximum(const Node& node, const Factors& factors, const double* lode, double* bounds) {
  const auto stresses = [&](std::size_t b, std::size_t g) {
    return Stresses<6>(node.unit, factors.values + b * factors.n_channels * block + g, factors.n_channels);
  };
  const std::size_t peak = block_of_largest(node.peaks, factors.n_blocks);
  Principal principal(lode);
  double squares[block];
  Lanes most = {};
  for (std::size_t g = 0; g < block; g += group) {
    const auto of_group = stresses(peak, g);
    principal.look_into(of_group, peak * block + g);
    for (std::size_t r = 0; r < n_registers; ++r) {
      store(squares + g + r * n_lanes, of_group.square(r));
      most = larger(of_group.square(r), most);
    }
  }
  bound_means(node.unit, factors, bounds);
  for (std::size_t b = 0; b < factors.n_blocks; ++b)
    if (b != peak && any(load(node.peaks + b * n_lanes) >= Lanes{} + principal.threshold(bounds[b])))
      for (std::size_t g = 0; g < block; g += group) principal.look_into(stresses(b, g), b * block + g);
  const double largest = largest_of(most);
  return {largest, principal.value, long(peak * block) + first_equal<n_registers>(squares, block, largest),
          principal.instant};
}

}  // namespace

void walk(const double* unit_stress, std::size_t n_nodes, const Factors& factors, const double* lode,
          double* room, NodeMaximum* maximum) {
  Node nodes[batch];
  for (std::size_t i = 0; i < n_nodes; ++i, room += factors.n_blocks * n_lanes)
    nodes[i] = {unit_stress + i * factors.n_channels * n_coordinates, room};
  for (std::size_t b = 0; b < factors.n_blocks; ++b)
    for (std::size_t i = 0; i < n_nodes; ++i)
      find_peaks(nodes[i], factors.values + b * factors.n_channels * block, factors.n_channels, b);
  for (std::size_t i = 0; i < n_nodes; ++i) maximum[i] = find_maximum(nodes[i], factors, lode, room);
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
