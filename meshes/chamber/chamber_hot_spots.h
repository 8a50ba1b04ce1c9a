/// Hot spots of the chamber's weld toes on the tube's outside.
#pragma once

#include <vector>

#include "meshes/chamber/chamber_layout.h"
#include "meshes/spacing/break_points.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// Adds the points of the paths to the break points, which already hold all edges and faces.
/// @param arcs arc length on the tube's outside (m), from the direction +x
std::vector<HotSpot> place_hot_spots(const Chamber& chamber, const ChamberLayout& layout, BreakPoints& arcs,
                                     BreakPoints& stations);

}  // namespace meshes
