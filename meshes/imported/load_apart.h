/// The mesh of a user's file, read and meshed by gmsh in a process of its own.
#pragma once

#include <filesystem>

#include "meshes/imported/import.h"
#include "meshes/solids/model_mesh.h"

namespace meshes {

enum class GeometryFormat { step, msh };

/// Format by the file's extension.
/// @throws GeometryRefused if it is another
GeometryFormat format_of(const std::filesystem::path& file);

/// The mesh of the file, which may consist of several parts; whatever gmsh does with it, this process goes
/// on.
/// @throws as build_imported, without naming the file: of damaged text, of solids, cells and orders, of a
/// gmsh that crashed, did not come to an end or ran out of memory, with what it was at
ModelMesh load_apart(const Import& import, double scale_to_m);

/// A STEP file read and not meshed: its volumes with the sizes of the CAD. Where a mesh has points there is
/// one, whose first coordinate is the number of cells that the control asks for.
/// @throws as load_apart
ModelMesh read_apart(const Import& import, double scale_to_m);

}  // namespace meshes
