/// The mesh of gmsh's current model as values, its surface divided into the pieces it came in.
#pragma once

#include <string>
#include <vector>

#include "meshes/solids/solid_control.h"
#include "meshes/values/cell_mesh.h"

namespace meshes {

/// A surface of the model, or a physical group of surfaces.
struct Piece {
  std::string name;  ///< of the physical group; empty: none
  int tag = 0;       ///< of the surface or of the group
  // Of a surface of the CAD, exact to rounding; 0: not known. What a mesh makes of a disc lies beside its
  // centre by some 1e-3 of the radius.
  double area_m2 = 0;
  Point centre_m{};  ///< of the area
};

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

/// Meshes the model's volumes and collects; inner nodes are moved where cells are flat. Surfaces that are in
/// no physical group have the area and centre of the CAD.
ModelMesh mesh_and_collect(const SolidControl& control, double unit_m);

/// Parts of the mesh that share no node.
int n_separate_parts(const CellMesh& mesh);

}  // namespace meshes
