/// Kinds of isoparametric cells and the counts that follow from them.
#pragma once

#include <cstddef>

namespace fem {

enum class CellKind {
  hexahedra,   ///< Q_k
  tetrahedra,  ///< P_2: 10 nodes, edges may be curved
};

struct CellShape {
  CellKind kind = CellKind::hexahedra;
  int degree = 2;  ///< of displacement and geometry; 2 for tetrahedra

  constexpr bool is_tetrahedron() const noexcept { return kind == CellKind::tetrahedra; }
  constexpr int n_corners() const noexcept { return is_tetrahedron() ? 4 : 8; }
  constexpr int n_faces() const noexcept { return is_tetrahedron() ? 4 : 6; }
  constexpr int n_face_corners() const noexcept { return is_tetrahedron() ? 3 : 4; }
  constexpr int nodes_per_cell() const noexcept {
    return is_tetrahedron() ? 10 : (degree + 1) * (degree + 1) * (degree + 1);
  }
  constexpr int nodes_per_face() const noexcept { return is_tetrahedron() ? 6 : (degree + 1) * (degree + 1); }
};

}  // namespace fem
