#include "pipelines/write/pictures/port_surface.h"

#include <map>
#include <utility>

namespace pipelines {
namespace {

/// The list's names, and for each face the place of its group in the list.
template <typename Named>
std::pair<NameList, IdField> mark(const char* ids, const char* names, const std::vector<Named>& list,
                                  const std::vector<std::int32_t>& group_of_face) {
  std::pair<NameList, IdField> marks{{names, {}}, {ids, {}, IdField::At::cells}};
  std::map<int, std::int32_t> place;
  for (const auto& entry : list) {
    marks.first.names.push_back(entry.name);
    place[entry.boundary_id] = static_cast<std::int32_t>(marks.first.names.size());
  }
  for (const auto group : group_of_face) {
    const auto found = place.find(group);
    marks.second.values.push_back(found == place.end() ? 0 : found->second);
  }
  return marks;
}

}  // namespace

MarkedFaces marked_faces(const fem::Nodes& nodes, const meshes::BodyMesh& mesh) {
  const auto& groups = nodes.face_boundary_id;
  auto [port_names, ports] = mark(port_fields::port, port_fields::port_names, mesh.ports, groups);
  auto [feature_names, features] =
      mark(port_fields::feature, port_fields::feature_names, mesh.features, groups);
  return {{std::move(port_names), std::move(feature_names)}, {std::move(ports), std::move(features)}};
}

void write_port_surface(const std::filesystem::path& vtu, const fem::Nodes& nodes,
                        const meshes::BodyMesh& mesh) {
  const auto marks = marked_faces(nodes, mesh);
  write_surface_snapshot_vtu(vtu, nodes, {}, marks.ids, VtuCompression::zlib, marks.names);
}

}  // namespace pipelines
