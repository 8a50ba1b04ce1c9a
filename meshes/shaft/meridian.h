/// The meridian of the shaft: quadrilaterals in the half plane (z, r) from the core or the bore to the
/// surface.
/// Lengths in m; r is the distance from the z axis before any eccentric shift.
#pragma once

#include <array>
#include <vector>

#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/shaft_layout/shaft_surfaces.h"
#include "meshes/spacing/grading.h"

namespace meshes {

struct MeridianPoint {
  double z_m = 0, r_m = 0;
};

/// Corners counter-clockwise in (z, r).
struct MeridianQuad {
  std::array<int, 4> corners{};
  int segment = 0;
};

/// A piece of the profile, the material on its left in (z, r).
struct MeridianEdge {
  std::array<int, 2> ends{};
  int boundary_id = 0;
};

/// A straight line of cell edges z = const from the core or the bore to the surface of one segment.
struct MeridianStation {
  double z_m = 0;
  int segment = 0;
};

/// Where a core of solid segments side by side is to be filled in.
struct CoreLine {
  std::vector<int> points;  ///< at the core's radius, ascending in z
  double radius_m = 0;
  int begin_id = 0, end_id = 0;  ///< boundaries that its two ends belong to
};

struct Meridian {
  std::vector<MeridianPoint> points;
  std::vector<MeridianQuad> quads;
  std::vector<MeridianEdge> edges;
  std::vector<CoreLine> cores;            ///< ascending in z
  std::vector<MeridianStation> stations;  ///< ascending in z, without the end faces
};

/// Wanted axial cell sizes in the column of a segment.
/// @param index  index of the segment
AxialSize axial_size(const ShaftLayout& layout, int index, const ShaftMeshControl& control);

/// Blocks: one column per segment, a fan of five at each fillet; transfinite inside, shared edges built once.
/// @param layout, control before subdivision
Meridian build_meridian(const ShaftLayout& layout, const SurfaceTable& surfaces,
                        const ShaftMeshControl& control);

}  // namespace meshes
