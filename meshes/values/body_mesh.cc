#include "meshes/values/body_mesh.h"

namespace meshes {

BodyMesh::BodyMesh() = default;
BodyMesh::BodyMesh(const BodyMesh&) = default;
BodyMesh::BodyMesh(BodyMesh&&) noexcept = default;
BodyMesh& BodyMesh::operator=(const BodyMesh&) = default;
BodyMesh& BodyMesh::operator=(BodyMesh&&) noexcept = default;
BodyMesh::~BodyMesh() = default;

}  // namespace meshes
