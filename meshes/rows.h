/// How many radial rows each segment has.
#pragma once

#include "meshes/shaft_layout.h"

namespace meshes {

/// Fills n_inner_rows and n_outer_rows so that the rows of neighbours fit at every junction.
/// @param n_least rows of a wall
void set_rows(ShaftLayout& layout, int n_sectors, int n_least);

/// Cells grow by at most this from row to row, away from the arcs: stress varies slowly there, and every row
/// runs on into the thicker segments.
inline constexpr double rows_ratio = 3;

}  // namespace meshes
