/// A shaft as a solid: which surfaces it has and where they lie. Lengths in m.
#pragma once

#include <vector>

#include "meshes/keyed_shaft/keyway.h"
#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/values/hex_mesh.h"

namespace meshes {

struct SolidSegment {
  double begin_m = 0, end_m = 0, radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
  double bare_begin_m = 0, bare_end_m = 0;  ///< between the fillets on its own surface
  double zone_begin_m = 0, zone_end_m = 0;  ///< loaded zone; the bare cylinder if it is no port
  bool is_eccentric() const { return axis_x_m != 0 || axis_y_m != 0; }
};

struct SolidLayout {
  std::vector<SolidSegment> segments;
  std::vector<double> fillets_m;
  double bore_radius_m = 0;  ///< 0: solid
};

/// @param shaft  has passed check_shaft
/// @throws GeometryRefused if the bore is not the same everywhere or leaves no wall
SolidLayout lay_out_solid(const Shaft& shaft);

/// Place of a point seen from a keyway: across its middle line, along z, and from the segment's axis towards
/// the middle line.
Point in_keyway(const Keyway& keyway, const SolidSegment& segment, const Point& point);
Point from_keyway(const Keyway& keyway, const SolidSegment& segment, const Point& local);

/// Place in shaft.segments of a keyway's segment.
/// @throws GeometryRefused if there is none
std::size_t segment_of(const Keyway& keyway, const Shaft& shaft);

/// @throws GeometryRefused as build_solid_shaft
void check_keyways(const Shaft& shaft, const SolidLayout& layout, const std::vector<Keyway>& keyways);

/// Builds the solid in gmsh's current model, lengths in mm; one volume.
void model_solid(const Shaft& shaft, const SolidLayout& layout, const std::vector<Keyway>& keyways);

}  // namespace meshes
