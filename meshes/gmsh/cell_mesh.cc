#include "meshes/gmsh/cell_mesh.h"

#include <gmsh.h>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

void add_groups(int dimension, const std::map<int, std::string>& names) {
  for (const auto& [id, name] : names) {
    gmsh::model::addDiscreteEntity(dimension, id);
    gmsh::model::addPhysicalGroup(dimension, {id}, id);
    gmsh::model::setPhysicalName(dimension, id, name);
  }
}

void add_elements(int type, const std::map<int, std::string>& names, const std::vector<int>& ids,
                  const std::vector<int>& nodes, std::size_t& next_tag) {
  const std::size_t n = ids.empty() ? 0 : nodes.size() / ids.size();
  for (const auto& group : names) {
    std::vector<std::size_t> tags, its_nodes;
    for (std::size_t e = 0; e < ids.size(); ++e) {
      if (ids[e] != group.first) continue;
      tags.push_back(next_tag++);
      for (std::size_t i = 0; i < n; ++i) its_nodes.push_back(static_cast<std::size_t>(nodes[n * e + i]) + 1);
    }
    if (!tags.empty()) gmsh::model::mesh::addElementsByType(group.first, type, tags, its_nodes);
  }
}

void fill_model(const CellMesh& mesh, const GroupNames& names) {
  gmsh::model::add("body");
  add_groups(2, names.boundaries);
  add_groups(3, names.volumes);
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    tags.push_back(i + 1);
    coordinates.insert(coordinates.end(), mesh.points[i].begin(), mesh.points[i].end());
  }
  gmsh::model::mesh::addNodes(3, names.volumes.begin()->first, tags, coordinates);
  const bool tetrahedra = mesh.kind == CellKind::tetrahedra;
  std::size_t next_tag = 1;
  add_elements(tetrahedra ? gmsh_triangle_6 : gmsh_quadrangle, names.boundaries, mesh.face_id, mesh.faces,
               next_tag);
  add_elements(tetrahedra ? gmsh_tetrahedron_10 : gmsh_hexahedron, names.volumes, mesh.volume_id, mesh.cells,
               next_tag);
}

}  // namespace

const std::vector<std::vector<int>>& local_faces(CellKind kind) {
  static const std::vector<std::vector<int>> tetrahedron = {
      {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}, {0, 3, 2, 7, 8, 6}};
  static const std::vector<std::vector<int>> hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return kind == CellKind::tetrahedra ? tetrahedron : hexahedron;
}

void write_msh(const CellMesh& mesh, const GroupNames& names, const std::filesystem::path& file) {
  write_msh_file(file, [&] { fill_model(mesh, names); });
}

}  // namespace meshes
