/// The cosine of the Lode angle, by which the largest principal stress follows from the invariants.
#pragma once

#include <array>

#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines {

/// Coefficients of the polynomial in t = 2 sqrt((1 + c) / 2) - 1, ascending powers.
const std::array<double, kernel::n_lode_terms>& lode_terms();

/// cos(acos(c) / 3), -1 <= c <= 1, to 1e-15.
double lode_cosine(double c);

}  // namespace pipelines
