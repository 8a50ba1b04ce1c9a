/// The named pieces of the shaft's surface and their ids, known before the mesh.
#pragma once

#include <vector>

#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/spacing/disc.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// Part of a segment's cylinder.
struct CylinderPiece {
  double begin_m = 0, end_m = 0;
  int boundary_id = 0;
};

/// Ids of the surface around one junction; 0 where there is none.
struct JunctionSurfaces {
  int fillet_id = 0, shoulder_id = 0;
  int step_id = 0;  ///< face of a bore step
};

/// Ids are unique over volumes and boundaries: core, ring groups, then features.
struct SurfaceTable {
  int core_id = 1;
  std::vector<int> ring_ids;  ///< one per segment
  std::vector<Feature> features;
  std::vector<std::vector<CylinderPiece>> cylinders;  ///< per segment, ascending in z
  std::vector<int> bore_ids;                          ///< per segment; 0: solid
  std::vector<JunctionSurfaces> junctions;
  int end_1_id = 0, end_2_id = 0;

  /// Id of the segment's surface at z (not on a fillet).
  int cylinder_at(int segment, double z_m) const;
};

SurfaceTable name_surfaces(const Shaft& shaft, const ShaftLayout& layout);

std::vector<Port> ports_of(const Shaft& shaft, const ShaftLayout& layout, const SurfaceTable& surfaces);
/// Circles in which the model has a sharp re-entrant corner: outer shoulders without a fillet, within 0.1 of
/// the smaller diameter, and bore steps, within the thickness of the wall of the wider bore. As polygons that
/// leave the circle by less than a thousandth of that distance, however few cells the mesh has around.
std::vector<SharpEdge> sharp_edges_of(const Shaft& shaft, const ShaftLayout& layout);

std::vector<CylinderChart> cylinders_of(const ShaftLayout& layout, const SurfaceTable& surfaces);
std::vector<TorusChart> tori_of(const ShaftLayout& layout, const SurfaceTable& surfaces);

}  // namespace meshes
