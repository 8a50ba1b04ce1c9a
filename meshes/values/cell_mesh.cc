#include "meshes/values/cell_mesh.h"

namespace meshes {

const std::vector<std::vector<int>>& local_faces(CellKind kind) {
  static const std::vector<std::vector<int>> tetrahedron = {
      {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}, {0, 3, 2, 7, 8, 6}};
  static const std::vector<std::vector<int>> hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return kind == CellKind::tetrahedra ? tetrahedron : hexahedron;
}

}  // namespace meshes
