/// Largest and smallest value over the instants of many linear forms of the factors, compiled for several
/// instruction sets; the best one that the machine has is called.
#pragma once

#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines::kernel {

/// What a linear form keeps of its walk: the extremes, and the first instant of each.
struct LinearExtremes {
  double largest = 0, smallest = 0;
  long largest_instant = 0, smallest_instant = 0;
};

/// Forms handled at once: they share each block of factors while it is in the cache.
constexpr std::size_t forms_at_once = 8;

/// What is looked for; of the other extreme nothing is found.
enum class Wanted { smallest, both };

/// f_i(t) = sum_k w_ki a_k(t) over all instants.
/// @param weights  n_channels x forms_at_once
/// @param room     room_of_linear_walk(factors), to be overwritten
/// @param found    forms_at_once, to be written
using LinearWalk = void(const double* weights, const Factors& factors, Wanted wanted, double* room,
                        LinearExtremes* found);

/// Numbers that a walk needs room for.
std::size_t room_of_linear_walk(const Factors& factors);

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
