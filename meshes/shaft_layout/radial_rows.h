/// How many radial rows each segment has.
#pragma once

#include "meshes/shaft_layout/shaft_layout.h"

namespace meshes {

/// What the rows follow besides the geometry.
struct RowControl {
  int n_sectors = 16;
  int n_least = 2;    ///< rows of a wall
  double factor = 1;  ///< times what these and the fans ask for, rounded up; >= 1
};

/// Fills n_inner_rows and n_outer_rows so that the rows of neighbours fit at every junction.
void set_rows(ShaftLayout& layout, const RowControl& control);

/// Cells grow by at most this from row to row, away from the arcs: stress varies slowly there, and every row
/// runs on into the thicker segments.
inline constexpr double rows_ratio = 3;

}  // namespace meshes
