/// Building blocks of a plan: rings and ruled strips. Lengths in m, angles in rad.
#pragma once

#include <vector>

#include "meshes/spacing/swept_plan.h"

namespace meshes {

/// Rows of points from inside to outside, each counter-clockwise: (row, column) is right-handed.
using PointRows = std::vector<std::vector<int>>;

/// Adds points on circles. With `inner_row` the first circle has these points already.
PointRows add_circles(Plan& plan, const std::array<double, 2>& centre_m, const std::vector<double>& radii_m,
                      const std::vector<double>& angles_rad, const std::vector<int>& inner_row = {});

/// Adds points on straight lines between two existing rows.
/// @param shares ascending from 0 (inner row) to 1 (outer row)
PointRows add_ruled_rows(Plan& plan, const std::vector<int>& inner_row, const std::vector<int>& outer_row,
                         const std::vector<double>& shares);

/// Cells between the rows. The ids are of the first row's and of the last row's edges; 0: none of their own.
void add_quads(PlanBlock& block, const PointRows& rows, bool closed, int inner_id, int outer_id);

}  // namespace meshes
