#include "fem/mesh/triangulation/array_checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fem/base/values/errors.h"

namespace fem {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw MeshUnusable("the mesh " + what);
}

void check_nodes(const std::vector<int>& nodes, std::size_t n_nodes) {
  for (const int node : nodes)
    if (node < 0 || std::size_t(node) >= n_nodes)
      refuse("names the node " + std::to_string(node) + " of " + std::to_string(n_nodes));
}

}  // namespace

void check_arrays(const CoarseMesh& mesh) {
  if (mesh.n_cells() == 0) refuse("has no cells");
  if (mesh.cells.size() != mesh.n_cells() * mesh.nodes_per_cell() ||
      mesh.faces.size() != mesh.n_faces() * mesh.nodes_per_face())
    refuse("has arrays of nodes and of ids whose lengths do not fit");
  check_nodes(mesh.cells, mesh.points_m.size());
  check_nodes(mesh.faces, mesh.points_m.size());
  for (const auto& point : mesh.points_m)
    for (const double x_m : point)
      if (!std::isfinite(x_m)) refuse("has a node whose place is not finite");
  const auto is_negative = [](int id) { return id < 0; };
  if (std::any_of(mesh.volume_id.begin(), mesh.volume_id.end(), is_negative) ||
      std::any_of(mesh.face_id.begin(), mesh.face_id.end(), is_negative))
    refuse("has a negative id of a group");
}

}  // namespace fem
