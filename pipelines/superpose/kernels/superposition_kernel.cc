/// Compiled once per instruction set (lanes.h). No other header with inline code may be included here.
#include "pipelines/superpose/kernels/superposition_kernel.h"

#include "pipelines/superpose/kernels/knots_kernel.h"
#include "pipelines/superpose/kernels/principal_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

// Registers of instants for five coordinates: fifteen sums fit the 32 registers of AVX-512, ten the sixteen
// of others.
constexpr std::size_t n_registers = n_lanes == 8 ? 3 : 2, group = n_registers * n_lanes;
static_assert(block % group == 0 && blocks_at_once % n_lanes == 0);

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

/// The squared von Mises stress from which on instants matter whose mean stress is at most `mean`.
/// @param value  the largest principal stress so far
double threshold(double value, double mean) {
  const double rest = 1.5 * (value - mean);
  return rest > 0 ? rest * rest * (1 - tolerance) : -1;
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
    const Stresses<5, n_registers> stresses(node.unit, a + g, n_channels);
#pragma GCC unroll 3
    for (std::size_t r = 0; r < n_registers; ++r) peak = larger(stresses.square(r), peak);
  }
  store(node.peaks + b * n_lanes, peak);
}

/// Looks again into the block of the largest von Mises stress, and into those that may have the largest
/// principal stress.
NodeMaximum find_maximum(const Node& node, const Factors& factors, const double* lode, double* bounds) {
  const auto stresses = [&](std::size_t b, std::size_t g) {
    return Stresses<6, n_registers>(node.unit, factors.values + b * factors.n_channels * block + g,
                                    factors.n_channels);
  };
  const std::size_t peak = block_of_largest(node.peaks, factors.n_blocks);
  Largest principal;
  double squares[block];
  Lanes most = {};
  for (std::size_t g = 0; g < block; g += group) {
    const auto of_group = stresses(peak, g);
    look_into(of_group, peak * block + g, lode, principal);
    for (std::size_t r = 0; r < n_registers; ++r) {
      store(squares + g + r * n_lanes, of_group.square(r));
      most = larger(of_group.square(r), most);
    }
  }
  bound_means(node.unit, factors, bounds);
  std::size_t n_blocks = 1;  // blocks that were superposed again
  for (std::size_t b = 0; b < factors.n_blocks; ++b)
    if (b != peak && any(load(node.peaks + b * n_lanes) >= Lanes{} + threshold(principal.value, bounds[b]))) {
      for (std::size_t g = 0; g < block; g += group)
        look_into(stresses(b, g), b * block + g, lode, principal);
      ++n_blocks;
    }
  const double largest = largest_of(most);
  return {largest,
          principal.value,
          long(peak * block) + first_equal<n_registers>(squares, block, largest),
          principal.instant,
          factors.n_blocks * block,
          n_blocks * block};
}

void walk_all_instants(const double* unit_stress, std::size_t n_nodes, const Factors& factors,
                       const double* lode, double* room, NodeMaximum* maximum) {
  Node nodes[batch];
  for (std::size_t i = 0; i < n_nodes; ++i, room += factors.n_blocks * n_lanes)
    nodes[i] = {unit_stress + i * factors.n_channels * n_coordinates, room};
  for (std::size_t b = 0; b < factors.n_blocks; ++b)
    for (std::size_t i = 0; i < n_nodes; ++i)
      find_peaks(nodes[i], factors.values + b * factors.n_channels * block, factors.n_channels, b);
  for (std::size_t i = 0; i < n_nodes; ++i) maximum[i] = find_maximum(nodes[i], factors, lode, room);
}

}  // namespace

void walk(const double* unit_stress, std::size_t n_nodes, const Factors& factors, const double* lode,
          double* room, NodeMaximum* maximum) {
  if (factors.knots.n_spans == 0)
    return walk_all_instants(unit_stress, n_nodes, factors, lode, room, maximum);
  for (std::size_t i = 0; i < n_nodes; ++i)
    maximum[i] = walk_knots(unit_stress + i * factors.n_channels * n_coordinates, factors, lode, room);
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
