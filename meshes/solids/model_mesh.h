/// The mesh of gmsh's current model as values, its surface divided into the pieces it came in.
#pragma once

#include <string>
#include <vector>

#include "meshes/solids/solid_control.h"
#include "meshes/values/cell_mesh.h"

namespace meshes {

/// A surface or volume of the model, or a physical group of these.
struct Piece {
  std::string name;  ///< of the physical group; empty: none
  int tag = 0;       ///< of the surface or volume, or of the group
  // Of the CAD, exact to rounding. What a mesh makes of a disc lies beside its centre by some 1e-3 of the
  // radius.
  double size = 0;           ///< area [m2] or volume [m3]; 0: not known
  Point centre_m{};          ///< of that area or volume
  double second_moment = 0;  ///< of the area [m4] or volume [m5]: squared distances from that centre
  std::string shape{};  ///< of a surface of a STEP file: "hole d 12 mm" (cad_surfaces.h); empty: not known
};

/// Of its group, else "hole d 12 mm (surface 8)", or "surface 8": unique, and the same for all meshes of a
/// file.
std::string name_of(const Piece& surface);

/// face_id is a place among the pieces, volume_id among the volumes.
struct ModelMesh {
  CellMesh mesh;
  std::vector<Piece> pieces;   ///< of the boundary
  std::vector<Piece> volumes;  ///< groups, or volumes that are in none
};

/// Tetrahedra of 10 nodes or hexahedra of 8 with the faces that bound them; surfaces inside are passed over,
/// and a part of the boundary on no surface is a piece without a tag. Cells that are inside out are turned.
/// @param unit_m  length of the model's unit
/// @throws GeometryRefused if there are no cells, or others, or both kinds, or a surface or volume is
/// in several groups
ModelMesh collect_model(double unit_m);

/// Meshes the model's volumes and collects; inner nodes are moved where cells are flat. Surfaces and
/// volumes that are in no physical group have the size and centre of the CAD.
ModelMesh mesh_and_collect(const SolidControl& control, double unit_m);

/// As of its size (reentrant_edges.h), of the CAD where that is known, so that it does not depend on the
/// mesh.
double usual_exclusion_m(const ModelMesh& model);

/// Parts of the mesh that share no node.
int n_separate_parts(const CellMesh& mesh);

}  // namespace meshes
