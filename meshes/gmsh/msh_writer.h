/// Writes a mesh with named groups as .msh 4.1.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "meshes/values/hex_mesh.h"

namespace meshes {

/// Names of the physical groups by id.
struct GroupNames {
  std::map<int, std::string> volumes, boundaries;
};

/// Writes to a temporary name beside `file`, then renames: a reader never sees half a mesh. The same mesh
/// gives the same bytes.
/// @throws MeshRefused if the directory is missing or the file cannot be written
void write_msh(const HexMesh& mesh, const GroupNames& names, const std::filesystem::path& file);

}  // namespace meshes
