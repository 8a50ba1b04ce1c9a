/// The inner loop of superposition, compiled for several instruction sets; the best one that the machine has
/// is called.
#pragma once

#include <cstddef>

namespace pipelines::kernel {

/// Instants handled at once; time factors are padded with the last instant to a multiple of it.
constexpr std::size_t block = 16;

/// Nodes handled at once.
constexpr std::size_t batch = 16;

/// What a node keeps of its walk through the instants: the first instant of each maximum.
struct NodeMaximum {
  double von_mises_squared = 0;
  double principal = 0;
  long von_mises_instant = 0, principal_instant = 0;
};

/// Terms of the polynomial for the Lode angle's cosine, cos(acos(c) / 3), in t = 2 sqrt((1 + c) / 2) - 1.
constexpr std::size_t n_lode_terms = 17;

/// For each of up to `batch` nodes: sigma = sum_k S_k a_k over n_blocks blocks of instants; the largest
/// squared von Mises stress and the largest principal stress, mean + 2/3 sigma_v cos(theta), which is
/// computed where it can be the largest. The nodes of a batch share each block of factors while it is in the
/// cache.
/// @param unit_stress  n_nodes x n_channels x 6 (xx, yy, zz, xy, yz, xz)
/// @param factors      n_blocks x n_channels x block
/// @param lode         n_lode_terms, ascending powers of t
/// @param maximum      n_nodes, to be written
using Walk = void(const double* unit_stress, std::size_t n_nodes, std::size_t n_channels,
                  const double* factors, std::size_t n_blocks, const double* lode, NodeMaximum* maximum);

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
