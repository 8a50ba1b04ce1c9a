/// Writes a mesh with named groups as .msh 4.1, for people to open.
#pragma once

#include <filesystem>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// Writes to a temporary name beside `file`, then renames: a reader never sees half a mesh. The same mesh
/// gives the same bytes. One call at a time in a process: gmsh is global.
/// @param body  with cells; its groups' ids become the tags of physical groups
/// @throws MeshRefused if the directory is missing or the file cannot be written
void write_msh(const BodyMesh& body, const std::filesystem::path& file);

}  // namespace meshes
