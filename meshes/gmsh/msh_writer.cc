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

void add_elements(const GroupedElements& elements, std::size_t& next_tag) {
  for (const auto& [group, nodes] : elements.groups()) {
    std::vector<std::size_t> tags(nodes.size() / elements.n_nodes());
    std::iota(tags.begin(), tags.end(), next_tag);
    next_tag += tags.size();
    gmsh::model::mesh::addElementsByType(group, elements.type(), tags, nodes);
  }
}

}  // namespace

void GroupedElements::add(int group, const int* nodes, std::size_t n_nodes) {
  n_nodes_ = n_nodes;
  auto& of_group = groups_[group];
  for (std::size_t i = 0; i < n_nodes; ++i) of_group.push_back(static_cast<std::size_t>(nodes[i]) + 1);
}

void write_msh(const std::vector<Point>& points, const GroupedElements& faces, const GroupedElements& cells,
               const GroupNames& names, const std::filesystem::path& file) {
  write_msh_file(file, [&] {
    gmsh::model::add("body");
    add_groups(2, names.boundaries);
    add_groups(3, names.volumes);
    add_nodes(points, names.volumes.begin()->first);
    std::size_t next_tag = 1;
    add_elements(faces, next_tag);
    add_elements(cells, next_tag);
  });
}

void write_msh(const HexMesh& mesh, const GroupNames& names, const std::filesystem::path& file) {
  GroupedElements faces(gmsh_quadrangle), cells(gmsh_hexahedron);
  for (const auto& quad : mesh.quads) faces.add(quad.boundary_id, quad.nodes.data(), quad.nodes.size());
  for (const auto& hex : mesh.hexes) cells.add(hex.volume_id, hex.nodes.data(), hex.nodes.size());
  write_msh(mesh.points, faces, cells, names, file);
}

}  // namespace meshes
