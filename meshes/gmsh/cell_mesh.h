/// A finished mesh of one kind of cell with group ids, as it is written: quadratic tetrahedra, or linear
/// hexahedra. Lengths in m. Nodes of cells and faces in gmsh's order; faces counter-clockwise seen from
/// outside.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "meshes/gmsh/msh_writer.h"
#include "meshes/values/body_mesh.h"
#include "meshes/values/hex_mesh.h"

namespace meshes {

struct CellMesh {
  CellKind kind = CellKind::tetrahedra;
  std::vector<Point> points;
  std::vector<int> cells;      ///< nodes_per_cell() each
  std::vector<int> volume_id;  ///< one per cell
  std::vector<int> faces;      ///< of the boundary, nodes_per_face() each
  std::vector<int> face_id;    ///< one per face

  std::size_t nodes_per_cell() const { return kind == CellKind::tetrahedra ? 10 : 8; }
  std::size_t nodes_per_face() const { return kind == CellKind::tetrahedra ? 6 : 4; }
  std::size_t corners_per_face() const { return kind == CellKind::tetrahedra ? 3 : 4; }
  std::size_t n_cells() const { return volume_id.size(); }
  std::size_t n_faces() const { return face_id.size(); }
  const int* cell(std::size_t i) const { return cells.data() + i * nodes_per_cell(); }
  const int* face(std::size_t i) const { return faces.data() + i * nodes_per_face(); }
};

/// Local nodes of the faces of one cell, in the order above.
const std::vector<std::vector<int>>& local_faces(CellKind kind);

/// Writes to a temporary name beside `file`, then renames. The same mesh gives the same bytes.
/// @throws MeshRefused if the directory is missing or the file cannot be written
void write_msh(const CellMesh& mesh, const GroupNames& names, const std::filesystem::path& file);

}  // namespace meshes
