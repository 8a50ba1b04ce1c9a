/// The inner loop of superposition, compiled for several instruction sets; the best one that the machine has
/// is called.
#pragma once

#include <cstddef>

namespace pipelines::kernel {

/// Instants handled at once; time factors are padded with zeros to a multiple of it.
constexpr std::size_t block = 16;

/// Nodes handled at once.
constexpr std::size_t batch = 16;

/// What a node keeps of its walk through the instants.
struct NodeMaximum {
  double von_mises_squared = 0;
  long instant = 0;
};

/// For each of up to `batch` nodes: sigma = sum_k S_k a_k over n_blocks blocks of instants; the largest
/// squared von Mises stress and its first instant, and per block an upper bound of the largest principal
/// stress, mean + 2/3 sigma_v cos(theta) with the Lode angle's cosine bounded from above. The nodes of a
/// batch share each block of factors while it is in the cache.
/// @param unit_stress  n_nodes x n_channels x 6 (xx, yy, zz, xy, yz, xz)
/// @param factors      n_blocks x n_channels x block
/// @param maximum      n_nodes, to be written
/// @param block_bound  n_nodes x n_blocks, to be written
using Walk = void(const double* unit_stress, std::size_t n_nodes, std::size_t n_channels,
                  const double* factors, std::size_t n_blocks, NodeMaximum* maximum, double* block_bound);

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
