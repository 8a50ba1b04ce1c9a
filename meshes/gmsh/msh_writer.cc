#include "meshes/gmsh/msh_writer.h"

#include <gmsh.h>

#include <cstddef>
#include <vector>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

/// Elements of one group.
struct Elements {
  std::vector<std::size_t> tags, nodes;
};

template <typename Cells, typename IdOf>
std::map<int, Elements> by_group(const Cells& cells, IdOf id_of, std::size_t& next_tag) {
  std::map<int, Elements> groups;
  for (const auto& cell : cells) groups[id_of(cell)];
  for (auto& [id, elements] : groups)
    for (const auto& cell : cells)
      if (id_of(cell) == id) {
        elements.tags.push_back(next_tag++);
        for (const int node : cell.nodes) elements.nodes.push_back(static_cast<std::size_t>(node) + 1);
      }
  return groups;
}

void add_group(int dimension, int id, const std::string& name) {
  gmsh::model::addDiscreteEntity(dimension, id);
  gmsh::model::addPhysicalGroup(dimension, {id}, id);
  gmsh::model::setPhysicalName(dimension, id, name);
}

/// All nodes are kept on the first volume: they are shared by the groups, and readers need each once.
void add_nodes(const HexMesh& mesh, int volume_id) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    tags.push_back(i + 1);
    coordinates.insert(coordinates.end(), mesh.points[i].begin(), mesh.points[i].end());
  }
  gmsh::model::mesh::addNodes(3, volume_id, tags, coordinates);
}

void fill_model(const HexMesh& mesh, const GroupNames& names) {
  gmsh::model::add("body");
  for (const auto& [id, name] : names.boundaries) add_group(2, id, name);
  for (const auto& [id, name] : names.volumes) add_group(3, id, name);
  add_nodes(mesh, names.volumes.begin()->first);
  std::size_t next_tag = 1;
  for (const auto& [id, quads] : by_group(
           mesh.quads, [](const BoundaryQuad& quad) { return quad.boundary_id; }, next_tag))
    gmsh::model::mesh::addElementsByType(id, gmsh_quadrangle, quads.tags, quads.nodes);
  for (const auto& [id, hexes] : by_group(
           mesh.hexes, [](const Hex& hex) { return hex.volume_id; }, next_tag))
    gmsh::model::mesh::addElementsByType(id, gmsh_hexahedron, hexes.tags, hexes.nodes);
}

}  // namespace

void write_msh(const HexMesh& mesh, const GroupNames& names, const std::filesystem::path& file) {
  write_msh_file(file, [&] { fill_model(mesh, names); });
}

}  // namespace meshes
