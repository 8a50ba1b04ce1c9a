/// Writes a mesh with named groups as .msh 4.1.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "meshes/values/hex_mesh.h"

namespace meshes {

/// Names of the physical groups by id.
struct GroupNames {
  std::map<int, std::string> volumes, boundaries;
};

/// Elements of one of gmsh's types by the id of their group: the nodes of each, as gmsh numbers them, from 1.
class GroupedElements {
public:
  explicit GroupedElements(int gmsh_type) : type_(gmsh_type) {}
  /// @param nodes  of the element, counted from 0, in gmsh's order
  void add(int group, const int* nodes, std::size_t n_nodes);
  int type() const noexcept { return type_; }
  std::size_t n_nodes() const noexcept { return n_nodes_; }  ///< of one element
  const std::map<int, std::vector<std::size_t>>& groups() const noexcept { return groups_; }

private:
  int type_;
  std::size_t n_nodes_ = 1;
  std::map<int, std::vector<std::size_t>> groups_;
};

/// Writes to a temporary name beside `file`, then renames: a reader never sees half a mesh. The same mesh
/// gives the same bytes.
/// @param faces, cells  of groups that have names
/// @throws MeshRefused if the directory is missing or the file cannot be written
void write_msh(const std::vector<Point>& points, const GroupedElements& faces, const GroupedElements& cells,
               const GroupNames& names, const std::filesystem::path& file);
void write_msh(const HexMesh& mesh, const GroupNames& names, const std::filesystem::path& file);

}  // namespace meshes
