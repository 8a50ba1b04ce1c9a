/// A finished mesh of one kind of cell with group ids, as values: what fem computes on and what is written
/// as .msh. Lengths in m. Nodes of cells and faces in gmsh's order; faces counter-clockwise seen from
/// outside.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace meshes {

using Point = std::array<double, 3>;  ///< x, y, z in m

enum class CellKind { hexahedra, tetrahedra };

/// Linear hexahedra (8 nodes), or quadratic tetrahedra (10 nodes).
struct CellMesh {
  CellKind kind = CellKind::tetrahedra;
  std::vector<Point> points;
  std::vector<int> cells;      ///< nodes_per_cell() each
  std::vector<int> volume_id;  ///< one per cell
  std::vector<int> faces;      ///< faces on the boundary, nodes_per_face() each
  std::vector<int> face_id;    ///< one per face

  std::size_t nodes_per_cell() const { return kind == CellKind::tetrahedra ? 10 : 8; }
  std::size_t nodes_per_face() const { return kind == CellKind::tetrahedra ? 6 : 4; }
  std::size_t corners_per_face() const { return kind == CellKind::tetrahedra ? 3 : 4; }
  std::size_t n_cells() const { return volume_id.size(); }
  std::size_t n_faces() const { return face_id.size(); }
  const int* cell(std::size_t i) const { return cells.data() + i * nodes_per_cell(); }
  const int* face(std::size_t i) const { return faces.data() + i * nodes_per_face(); }
};

/// Names of the groups by id.
struct GroupNames {
  std::map<int, std::string> volumes, boundaries;
};

/// Local nodes of the faces of one cell, in the order above.
const std::vector<std::vector<int>>& local_faces(CellKind kind);

}  // namespace meshes
