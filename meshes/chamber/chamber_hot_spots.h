/// Hot spots of the chamber's weld toes on the tube's outside.
#pragma once

#include <string>
#include <vector>

#include "meshes/chamber/chamber_layout.h"
#include "meshes/spacing/break_points.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

struct ChamberHotSpots {
  std::vector<HotSpot> hot_spots;
  std::vector<std::string> covered;  ///< names of those that another plate or a flange is in the way of
};

/// Adds the points of the paths to the break points, which already hold all edges and faces. A point that
/// comes closer to one of these than cells can be short moves there.
/// @param arcs arc length on the tube's outside (m), from the direction +x
ChamberHotSpots place_hot_spots(const Chamber& chamber, const ChamberLayout& layout, BreakPoints& arcs,
                                BreakPoints& stations);

}  // namespace meshes
