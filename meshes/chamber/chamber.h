/// The chamber of a vibratory mill, meshed with structured hexahedra: planar blocks in the cross-section
/// (x, y) times stations in z.
/// Frame: origin E' on the exciter housing's axis, z = 0 in the middle of the chamber, front is +z.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "meshes/chamber/chamber_geometry.h"
#include "meshes/spacing/swept_plan.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// Meshes the chamber.
/// Ports: "housing_bore", "inner_wall" (the tube's whole inside), "spring_foot_1".. (the undersides of the
/// foot's two pads; their topsides if the foot lies above the tube's axis) and "covers" (the flanges' outer
/// faces, both ends).
/// Regions: "structure", "exciter" (the housing). Sharp edges: the weld toes.
/// Hot spots, on the tube's outside: around the tube from both edges of each plate at its mid-plane, and
/// along it from both faces of each plate at its middle and one wall inside its edges. A path that another
/// plate or flange covers or approaches within 0.4 walls is left out, and named in `covered_toes`. A point
/// that would come closer than 0.05 walls to another edge, station or point moves there.
/// @throws GeometryRefused with the offending numbers: sizes outside the ranges above, parts too close
///         to each other, edges or faces closer than 0.05 walls that do not coincide, bad controls
/// @throws MeshRefused if the worst cell is below control.min_scaled_jacobian (place and value named)
BodyMesh build_chamber(const Chamber& chamber, const ChamberMeshControl& control);

/// What is known of a chamber before it is meshed.
struct ChamberDescription {
  BodyMesh body;                       ///< as build_chamber's, without cells, quality and sharp edges
  std::map<int, SweptVolume> volumes;  ///< by volume id: rings exact, plates with straight edges at the tube
  std::size_t n_cells = 0;             ///< cells that build_chamber would make
};

/// @throws GeometryRefused as build_chamber
ChamberDescription describe_chamber(const Chamber& chamber, const ChamberMeshControl& control);

}  // namespace meshes
