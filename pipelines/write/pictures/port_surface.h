/// The surface of a body with its ports marked.
#pragma once

#include <filesystem>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/write/exports/vtk_files.h"

namespace pipelines {

/// Names of the cell fields and lists of words in the file.
namespace port_fields {
inline constexpr const char* port = "port";             ///< per face: place in the list, from 1; 0: none
inline constexpr const char* port_names = "port name";  ///< list
inline constexpr const char* feature = "feature";       ///< per face: place in the list, from 1; 0: none
inline constexpr const char* feature_names = "feature name";  ///< list
}  // namespace port_fields

/// Fields `port` and `feature` of the boundary faces, with the lists of names.
struct MarkedFaces {
  std::vector<NameList> names;
  std::vector<IdField> ids;  ///< at cells of the surface
};

/// @param nodes  nodes of the body that was made of this mesh
MarkedFaces marked_faces(const fem::Nodes& nodes, const meshes::BodyMesh& mesh);

/// The boundary faces as a VTU file: per face `port`, `feature` and `boundary_id`; the names as field data.
/// @param nodes  nodes of the body that was made of this mesh
/// @throws FileError naming the file if it cannot be written
void write_port_surface(const std::filesystem::path& vtu, const fem::Nodes& nodes,
                        const meshes::BodyMesh& mesh);

}  // namespace pipelines
