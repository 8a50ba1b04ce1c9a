#include "meshes/gmsh/cell_mesh.h"

#include "meshes/values/constants.h"

namespace meshes {

const std::vector<std::vector<int>>& local_faces(CellKind kind) {
  static const std::vector<std::vector<int>> tetrahedron = {
      {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}, {0, 3, 2, 7, 8, 6}};
  static const std::vector<std::vector<int>> hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return kind == CellKind::tetrahedra ? tetrahedron : hexahedron;
}

void write_msh(const CellMesh& mesh, const GroupNames& names, const std::filesystem::path& file) {
  const bool tetrahedra = mesh.kind == CellKind::tetrahedra;
  GroupedElements faces(tetrahedra ? gmsh_triangle_6 : gmsh_quadrangle),
      cells(tetrahedra ? gmsh_tetrahedron_10 : gmsh_hexahedron);
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    faces.add(mesh.face_id[f], mesh.face(f), mesh.nodes_per_face());
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    cells.add(mesh.volume_id[c], mesh.cell(c), mesh.nodes_per_cell());
  write_msh(mesh.points, faces, cells, names, file);
}

}  // namespace meshes
