/// The cross-section of one foot: its pad as a grid of rectangles, its lug ruled from the tube to the pad.
#pragma once

#include <vector>

#include "meshes/chamber/chamber_layout.h"
#include "meshes/chamber/chamber_stations.h"
#include "meshes/spacing/swept_plan.h"

namespace meshes {

struct FootBlocks {
  PlanBlock pad, lug;  ///< without slabs
};

/// @param tube_row points of the tube's outside from one edge of the lug to the other
/// @param columns_rad their angles from the foot's direction, ascending
/// @param sole_id boundary group of the loaded side
FootBlocks add_foot(Plan& plan, const Chamber& chamber, const ChamberLayout& layout, std::size_t foot,
                    const std::vector<int>& tube_row, const std::vector<double>& columns_rad,
                    const ToeSizes& sizes, int sole_id);

}  // namespace meshes
