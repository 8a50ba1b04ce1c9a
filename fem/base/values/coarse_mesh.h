/// The cells of a body before any refinement, as plain arrays. No deal.II in this header.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem/base/values/cell_shape.h"

namespace fem {

/// Linear hexahedra, or quadratic tetrahedra (10 nodes, curved as they are). Nodes are counted from 0, those
/// of cells and faces in gmsh's order. Volume and boundary ids are not negative.
struct CoarseMesh {
  CellKind kind = CellKind::hexahedra;
  std::vector<std::array<double, 3>> points_m;
  std::vector<int> cells;      ///< nodes_per_cell() each
  std::vector<int> volume_id;  ///< one per cell
  std::vector<int> faces;      ///< of the boundary, nodes_per_face() each; corners in any sense of rotation
  std::vector<int> face_id;    ///< one per face

  std::size_t nodes_per_cell() const noexcept { return kind == CellKind::tetrahedra ? 10 : 8; }
  std::size_t nodes_per_face() const noexcept { return kind == CellKind::tetrahedra ? 6 : 4; }
  std::size_t n_cells() const noexcept { return volume_id.size(); }
  std::size_t n_faces() const noexcept { return face_id.size(); }
  const int* cell(std::size_t i) const { return cells.data() + i * nodes_per_cell(); }
  const int* face(std::size_t i) const { return faces.data() + i * nodes_per_face(); }
};

}  // namespace fem
