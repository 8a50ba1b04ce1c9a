#include "fem/mesh/tetrahedra_reader.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "fem/values/errors.h"

namespace fem {

namespace {

constexpr int tetrahedron_4 = 4, tetrahedron_10 = 11, triangle_6 = 9;  // gmsh's types

/// gmsh's place of our node: the last two edges change places.
constexpr std::array<int, 10> gmsh_place = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

using Corners = std::array<std::int32_t, 3>;
Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw MeshUnusable("the mesh file " + name + what);
}

int group_of(const MshFile& mesh, const MshFile::Elements& block, const std::string& name) {
  const auto found = mesh.group.find({block.dimension, block.entity});
  if (found == mesh.group.end())
    refuse(name, ": its volume " + std::to_string(block.entity) +
                     " is in no physical group; add one to every volume and surface");
  return found->second;
}

void add_cells(const MshFile& mesh, const std::vector<std::int32_t>& node_of_place, const std::string& name,
               Grid& grid) {
  for (const auto& block : mesh.elements) {
    if (block.dimension != 3 || block.nodes.empty()) continue;
    if (block.type == tetrahedron_4)
      refuse(name, " has tetrahedra of 4 nodes, too stiff for stresses: raise them to second order");
    if (block.type != tetrahedron_10)
      refuse(name, " mixes tetrahedra with other cells (gmsh's type " + std::to_string(block.type) +
                       "): mesh the whole body with tetrahedra of 10 nodes");
    const int group = group_of(mesh, block, name);
    for (std::size_t e = 0; e < block.nodes.size(); e += 10) {
      for (const int i : gmsh_place)
        grid.cell_nodes.push_back(node_of_place[mesh.place_of_node.at(block.nodes[e + i])]);
      grid.volume_id.push_back(group);
    }
  }
}

/// Physical group of every triangle in the file, by its corners.
std::map<Corners, int> triangle_groups(const MshFile& mesh, const std::vector<std::int32_t>& node_of_place) {
  std::map<Corners, int> groups;
  for (const auto& block : mesh.elements) {
    if (block.type != triangle_6) continue;
    const auto group = mesh.group.find({2, block.entity});
    if (group == mesh.group.end()) continue;
    for (std::size_t e = 0; e < block.nodes.size(); e += 6) {
      Corners corners;
      for (int i = 0; i < 3; ++i) corners[i] = node_of_place[mesh.place_of_node.at(block.nodes[e + i])];
      groups[sorted(corners)] = group->second;
    }
  }
  return groups;
}

void add_boundary(const std::map<Corners, int>& groups, const std::string& name, Grid& grid) {
  const auto corners_of = [&](std::size_t cell, int face) {
    const auto local = face_nodes(grid.shape(), face);
    const auto* nodes = grid.nodes_of(cell);
    return sorted({nodes[local[0]], nodes[local[1]], nodes[local[2]]});
  };
  std::vector<Corners> all;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < 4; ++f) all.push_back(corners_of(c, f));
  std::sort(all.begin(), all.end());
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < 4; ++f) {
      const Corners corners = corners_of(c, f);
      const auto range = std::equal_range(all.begin(), all.end(), corners);
      if (range.second - range.first > 1) continue;
      const auto group = groups.find(corners);
      if (group == groups.end()) {
        const double* x = grid.position(corners[0]);
        std::ostringstream what;
        what << ": the surface near (" << x[0] << ", " << x[1] << ", " << x[2]
             << ") m has no triangles of 6 nodes in a physical group; add every surface to one";
        refuse(name, what.str());
      }
      grid.boundary.push_back({static_cast<std::int32_t>(c), f, group->second});
    }
}

}  // namespace

bool has_tetrahedra(const std::vector<int>& element_types) {
  return std::any_of(element_types.begin(), element_types.end(), [](int type) {
    return type == tetrahedron_4 || type == tetrahedron_10 || type == triangle_6;
  });
}

Grid tetrahedra_grid(const MshFile& mesh, const std::string& name) {
  // Nodes that no cell uses (construction points) are left out; the others keep the file's order.
  std::vector<std::int32_t> node_of_place(mesh.xyz_m.size() / 3, -1);
  for (const auto& block : mesh.elements)
    if (block.dimension == 3)
      for (const auto node : block.nodes) node_of_place[mesh.place_of_node.at(node)] = 0;
  Grid grid;
  grid.kind = CellKind::tetrahedra;
  grid.degree = 2;
  for (std::size_t place = 0; place < node_of_place.size(); ++place)
    if (node_of_place[place] == 0) {
      node_of_place[place] = static_cast<std::int32_t>(grid.n_nodes++);
      grid.xyz_m.insert(grid.xyz_m.end(), &mesh.xyz_m[3 * place], &mesh.xyz_m[3 * place] + 3);
    }
  add_cells(mesh, node_of_place, name, grid);
  add_boundary(triangle_groups(mesh, node_of_place), name, grid);
  return grid;
}

}  // namespace fem
