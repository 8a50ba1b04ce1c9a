/// Half of a shaft's lengthwise section: quadrilaterals in (z, r) from the axis or the bore to the surface.
/// Lengths in m.
#pragma once

#include <vector>

#include "meshes/shaft/meridian.h"

namespace meshes {

struct HalfSection {
  std::vector<MeridianPoint> points;
  std::vector<MeridianQuad> quads;
  std::vector<MeridianEdge> edges;  ///< edges on the surface; none on the axis
};

/// The blocks of build_shaft with the core filled down to the axis, and with its boundary ids. Eccentric
/// segments are made concentric.
/// @throws GeometryRefused as build_shaft
HalfSection build_half_section(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
