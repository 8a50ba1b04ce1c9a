/// Refusals of chambers that cannot be meshed.
#pragma once

#include "meshes/chamber/chamber_geometry.h"
#include "meshes/chamber/chamber_layout.h"

namespace meshes {

/// Sizes on their own: positive, finite, within the ranges that chamber.h states.
/// @throws GeometryRefused with the offending numbers (mm) and what to change
void check_sizes(const Chamber& chamber);
void check_control(const ChamberMeshControl& control);

/// @param layout  layout of the chamber and the control
/// @throws TooManyCells naming size_m, from the cells of the tube alone
void check_cells(const Chamber& chamber, const ChamberLayout& layout, const ChamberMeshControl& control);

/// Parts against each other: they keep clear where they share a range of z; edges of plates taper by at most
/// 1 in 2.
/// @throws GeometryRefused naming the parts, their distance and the least one, or the taper
void check_clearances(const Chamber& chamber, const ChamberLayout& layout);

}  // namespace meshes
