/// The inner loop of superposition, compiled for several instruction sets; the best one that the machine has
/// is called.
#pragma once

#include <cstddef>

namespace pipelines::kernel {

/// Instants handled at once; time factors are padded with the last instant to a multiple of it. Three
/// registers of AVX-512, with which 720 and 2400 instants leave nothing over.
constexpr std::size_t block = 24;

/// Blocks whose bounds are handled at once; bounds are padded to a multiple of it.
constexpr std::size_t blocks_at_once = 16;

/// Nodes handled at once.
constexpr std::size_t batch = 8;

/// Coordinates of a stress: five of its deviator, by whose 2-norm von Mises stress is given
/// (deviatoric_coordinates.h), and the mean of its normal stresses.
constexpr std::size_t n_coordinates = 6;

/// Instants of a span: it begins at a knot and ends before the next one.
constexpr std::size_t span = 8;

/// Knots that share deviations.
constexpr std::size_t knots_at_once = 8;

/// Time factors that are smooth enough to tell by some instants, the knots, where others matter. Knots are
/// the first instant of each span, and the last instant. A norm of the stress is convex, and so is its
/// largest principal stress: over a span each is at most the larger one of the two knots, and that of the
/// deviations.
struct Knots {
  std::size_t n_spans = 0;         ///< one less than the knots; 0: the factors are too rough
  std::size_t last = 0;            ///< instant, of the last knot
  std::size_t n_blocks = 0;        ///< blocks of knots, padded with the last one
  std::size_t n_deviations = 0;    ///< a multiple of knots_at_once
  const double* values = nullptr;  ///< n_blocks x n_channels x block
  /// At the share t of a span a factor differs from the straight line between the knots at its ends by
  /// 4 t (1 - t) times the deviation at most: one for knots_at_once knots and the spans beside them. The last
  /// one is what sums of this factor are wrong by, for rounding; it is part of the others.
  /// n_channels x n_deviations
  const double* deviations = nullptr;
};

/// Time factors of the channels.
struct Factors {
  std::size_t n_channels = 0, n_blocks = 0;
  std::size_t n_bounds = 0;        ///< n_blocks rounded up to a multiple of blocks_at_once
  const double* values = nullptr;  ///< n_blocks x n_channels x block
  /// Over a block a channel's factor lies within `middle` - `reach` and `middle` + `reach`.
  /// n_channels x (n_bounds / blocks_at_once) x (middle, reach) x blocks_at_once
  const double* bounds = nullptr;
  Knots knots;
};

/// What a node keeps of its walk through the instants: the first instant of each maximum.
struct NodeMaximum {
  double von_mises_squared = 0;
  double principal = 0;
  long von_mises_instant = 0, principal_instant = 0;
  /// Instants that were superposed, with five coordinates and with six. Of a span that is looked into its
  /// knot is counted once, and nothing that fills the knots' last block.
  std::size_t n_with_five = 0, n_with_six = 0;
};

/// Terms of the polynomial for the Lode angle's cosine, cos(acos(c) / 3), in t = 2 sqrt((1 + c) / 2) - 1.
constexpr std::size_t n_lode_terms = 17;

/// Numbers that a walk needs room for.
std::size_t room_of_walk(const Factors& factors);

/// For each of up to `batch` nodes: sigma = sum_k S_k a_k over all instants; the largest squared von Mises
/// stress and the largest principal stress, mean + 2/3 sigma_v cos(theta).
///
/// Where the factors have knots, the stress is superposed at these, and then in spans beside knots at which a
/// measure of stress and its deviation reach what the knots have as the largest. Whether the principal stress
/// does is told by the characteristic polynomial; the angle is computed where it is larger.
///
/// Without knots, for rougher factors, all instants take five multiply-adds per channel and the five squares.
/// The largest squares of each block are kept; the block that has the largest is superposed once more, with
/// the mean stress, and so are blocks where a bound of the mean and 2/3 of the largest von Mises stress reach
/// the largest principal stress so far. The nodes of a batch share each block of factors while it is in the
/// cache.
/// @param unit_stress  n_nodes x n_channels x n_coordinates
/// @param lode         n_lode_terms, ascending powers of t
/// @param room         room_of_walk(factors), to be overwritten
/// @param maximum      n_nodes, to be written
using Walk = void(const double* unit_stress, std::size_t n_nodes, const Factors& factors, const double* lode,
                  double* room, NodeMaximum* maximum);

/// The variant for this machine, chosen once.
Walk& walk_for_this_machine();

#if defined(__x86_64__)
namespace avx512 {
Walk walk;
}
namespace avx2 {
Walk walk;
}
#endif
namespace generic {
Walk walk;
}

}  // namespace pipelines::kernel
