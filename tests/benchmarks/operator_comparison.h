/// K x of our operator beside that of deal.II's MatrixFree and of a sparse matrix, one thread each.
#pragma once

#include "fem/values/body.h"

namespace measure {

/// Prints unknowns per second and load case, and ratios.
/// @param distorted  moves every node: no two cells are alike, and no cell is a parallelepiped
void compare_operators(const char* name, const fem::Body& body, bool distorted);

}  // namespace measure
