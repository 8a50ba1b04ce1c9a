/// The walk of nodes over the knots of smooth factors, and over the spans that matter. Compiled once per
/// instruction set.
#pragma once

#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {

/// Maxima of one node, as kernel::Walk finds them.
NodeMaximum walk_knots(const double* unit, const Factors& factors, const double* lode, double* room);

}  // namespace pipelines::kernel::KERNEL_VARIANT
