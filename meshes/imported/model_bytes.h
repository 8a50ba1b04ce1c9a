/// A mesh with its surfaces, or the refusal of one, as bytes that pass from one process to another on the
/// same machine.
#pragma once

#include <functional>
#include <string>

#include "meshes/solids/model_mesh.h"

namespace meshes {

/// The model that the action makes, or what it throws: gmsh's plain strings and everything without a name
/// here become GeometryRefused.
/// @throws std::bad_alloc alone
std::string bytes_of(const std::function<ModelMesh()>& action);

/// The model, its indices checked.
/// @throws GeometryRefused, TooManyCells or MeshRefused, as the action did; MeshRefused if the bytes do not
/// come from bytes_of
ModelMesh model_from(const std::string& bytes);

}  // namespace meshes
