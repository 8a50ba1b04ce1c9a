/// Largest and smallest value over the instants of many linear forms of the factors, compiled for several
/// instruction sets; the best one that the machine has is called.
#pragma once

#include <cstddef>

namespace pipelines::kernel {

/// What a linear form keeps of its walk: the extremes, and the first instant of each.
struct LinearExtremes {
  double largest = 0, smallest = 0;
  long largest_instant = 0, smallest_instant = 0;
};

/// Forms handled at once: they share each block of factors while it is in the cache.
constexpr std::size_t forms_at_once = 4;

/// f_i(t) = sum_k w_ik a_k(t) over n_blocks blocks of `block` instants (superposition_kernel.h).
/// @param weights  n_forms x n_channels, n_forms a multiple of forms_at_once
/// @param factors  n_blocks x n_channels x block
/// @param found    n_forms, to be written
using LinearWalk = void(const double* weights, std::size_t n_forms, std::size_t n_channels,
                        const double* factors, std::size_t n_blocks, LinearExtremes* found);

/// The variant for this machine.
LinearWalk& linear_walk_for_this_machine();

#if defined(__x86_64__)
namespace avx512 {
LinearWalk linear_walk;
}
namespace avx2 {
LinearWalk linear_walk;
}
#endif
namespace generic {
LinearWalk linear_walk;
}

}  // namespace pipelines::kernel
