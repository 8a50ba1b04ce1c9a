#include "meshes/gmsh/msh_writer.h"

#include <gmsh.h>

#include <numeric>

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

/// All nodes are kept on one volume: they are shared by the groups, and readers need each once.
void add_nodes(const std::vector<Point>& points, int volume_id) {
  std::vector<std::size_t> tags(points.size());
  std::iota(tags.begin(), tags.end(), 1);
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const auto& point : points) coordinates.insert(coordinates.end(), point.begin(), point.end());
  gmsh::model::mesh::addNodes(3, volume_id, tags, coordinates);
}

/// Elements of one of gmsh's types, each in the group with its id.
void add_elements(int type, const std::vector<int>& nodes, const std::vector<int>& ids,
                  std::size_t& next_tag) {
  const std::size_t n_nodes = ids.empty() ? 0 : nodes.size() / ids.size();
  std::map<int, std::vector<std::size_t>> of_group;  // gmsh counts nodes from 1
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t k = 0; k < n_nodes; ++k)
      of_group[ids[i]].push_back(std::size_t(nodes[i * n_nodes + k]) + 1);
  for (const auto& [group, elements] : of_group) {
    std::vector<std::size_t> tags(elements.size() / n_nodes);
    std::iota(tags.begin(), tags.end(), next_tag);
    next_tag += tags.size();
    gmsh::model::mesh::addElementsByType(group, type, tags, elements);
  }
}

}  // namespace

void write_msh(const BodyMesh& body, const std::filesystem::path& file) {
  const CellMesh& mesh = *body.cells;
  const bool tetrahedra = mesh.kind == CellKind::tetrahedra;
  write_msh_file(file, [&] {
    gmsh::model::add("body");
    add_groups(2, body.groups.boundaries);
    add_groups(3, body.groups.volumes);
    add_nodes(mesh.points, body.groups.volumes.begin()->first);
    std::size_t next_tag = 1;
    add_elements(tetrahedra ? gmsh_triangle_6 : gmsh_quadrangle, mesh.faces, mesh.face_id, next_tag);
    add_elements(tetrahedra ? gmsh_tetrahedron_10 : gmsh_hexahedron, mesh.cells, mesh.volume_id, next_tag);
  });
}

}  // namespace meshes
