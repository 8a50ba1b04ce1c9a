/// The mesh of gmsh's current model as values, its surface divided into the pieces it came in.
#pragma once

#include <string>
#include <vector>

#include "meshes/solids/solid_control.h"
#include "meshes/values/body_mesh.h"
#include "meshes/values/cell_mesh.h"

namespace meshes {

/// A surface or volume of the model, or a physical group of these.
struct Piece {
  std::string name;  ///< name of the physical group, "a + b" of several; empty: none
  int tag = 0;       ///< tag of the surface or volume, or of the group
  // Sizes are those of the CAD, exact to rounding. What a mesh makes of a disc lies beside its centre by some
  // 1e-3 of the radius.
  double size = 0;   ///< area [m2] or volume [m3]; 0: not known
  Point centre_m{};  ///< centre of that area or volume
  /// Second moment of the area [m4] or volume [m5]: squared distances from that centre.
  double second_moment = 0;
  std::vector<std::string> groups{};  ///< names of all physical groups that it belongs to
  /// Shape of a surface of a STEP file: "hole d 12 mm" (cad_surfaces.h); empty: not known.
  std::string shape{};
  /// Radius of the rounding of a weld's edge that it is; 0: it is none. Points along the edge as it was.
  double notch_radius_m = 0;
  std::vector<Point> notch_course_m{};
};

/// Name of a surface: its group's, else "hole d 12 mm (surface 8)", or "surface 8"; unique, and the same for
/// all meshes of a file.
std::string name_of(const Piece& surface);

/// face_id is a place among the pieces, volume_id among the volumes.
struct ModelMesh {
  CellMesh mesh;
  std::vector<Piece> pieces;   ///< pieces of the boundary
  std::vector<Piece> volumes;  ///< groups, or volumes that are in none
  /// Names of groups of surfaces that a .msh has without a surface in them; only for messages.
  std::vector<std::string> empty_groups{};
  std::vector<StraightEdge> straight_edges;
  double smallest_size_m = 0;  ///< shortest edge as taken (cell_estimate.h)
};

/// Tetrahedra of 10 nodes or hexahedra of 8 with the faces that bound them; surfaces inside are passed over,
/// and a part of the boundary on no surface is a piece without a tag. Cells that are inside out are turned.
/// @param unit_m  length of the model's unit
/// @throws GeometryRefused if there are no cells, or others, or both kinds
ModelMesh collect_model(double unit_m);

/// Meshes the model's volumes and collects; inner nodes are moved where cells are flat, and edges in tangent
/// wedges made straighter. Where gmsh fails, or cells stay bad, slightly smaller cells are tried, twice.
/// Surfaces and volumes that are in no physical group have the size and centre of the CAD.
ModelMesh mesh_and_collect(const SolidControl& control, double unit_m);

/// The worst scaled Jacobian that is good enough: min_scaled_jacobian, or a tenth of it where edges between
/// tangent faces are straight, since cells there are the flatter, the smaller they are.
double least_scaled_jacobian(const ModelMesh& model, const SolidControl& control);

/// The exclusion that follows from the body's size (reentrant_edges.h), of the CAD where that is known, so
/// that it does not depend on the mesh.
double usual_exclusion_m(const ModelMesh& model);

/// The part, from 0, that each cell belongs to: parts share no face of a cell. At a node or an edge alone
/// they would hang as on a hinge.
std::vector<int> separate_parts(const CellMesh& mesh);

}  // namespace meshes
