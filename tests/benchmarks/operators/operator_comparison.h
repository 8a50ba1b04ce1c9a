/// K x of our operator beside that of deal.II's MatrixFree, with one lane and with those of the machine, and
/// of a sparse matrix, one thread each.
#pragma once

#include "fem/values/body.h"

namespace measure {

/// Prints unknowns per second and load case, and ratios.
/// @param distorted  moves the inner vertices: no two cells are alike, and none inside is a parallelepiped
/// @throws std::runtime_error if MatrixFree's product differs from ours by more than rounding
void compare_operators(const char* name, const fem::Body& body, bool distorted);

}  // namespace measure
