#include "fem/mesh/triangulation/tetrahedra_grid.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "fem/base/values/errors.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/connected_pieces.h"

namespace fem {

namespace {

/// gmsh's place of our node: the last two edges change places.
constexpr std::array<int, 10> gmsh_place = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

using Corners = std::array<std::int32_t, 3>;
Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Group of every face of the mesh, by its corners.
std::map<Corners, int> groups_of_faces(const CoarseMesh& mesh,
                                       const std::vector<std::int32_t>& node_of_point) {
  std::map<Corners, int> groups;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = node_of_point[std::size_t(mesh.face(f)[i])];
    groups[sorted(corners)] = mesh.face_id[f];
  }
  return groups;
}

[[noreturn]] void refuse_bare_surface(const double* x_m) {
  std::ostringstream what;
  what << "the mesh's surface near (" << x_m[0] << ", " << x_m[1] << ", " << x_m[2]
       << ") m has no face in a group: add every surface to one";
  throw MeshUnusable(what.str());
}

void add_boundary(const std::map<Corners, int>& groups, Grid& grid) {
  const auto beyond = cells_beyond_faces(grid);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < 4; ++f) {
      if (beyond[4 * c + std::size_t(f)] >= 0) continue;
      const auto nodes = nodes_of_face(grid, c, f);
      const Corners corners = sorted({nodes[0], nodes[1], nodes[2]});
      const auto group = groups.find(corners);
      if (group == groups.end()) refuse_bare_surface(grid.position(corners[0]));
      grid.boundary.push_back({static_cast<std::int32_t>(c), f, group->second});
    }
}

}  // namespace

Grid tetrahedra_grid(const CoarseMesh& mesh) {
  std::vector<std::int32_t> node_of_point(mesh.points_m.size(), -1);
  for (const int point : mesh.cells) node_of_point[std::size_t(point)] = 0;
  Grid grid;
  grid.kind = CellKind::tetrahedra;
  grid.degree = 2;
  for (std::size_t point = 0; point < node_of_point.size(); ++point)
    if (node_of_point[point] == 0) {
      node_of_point[point] = static_cast<std::int32_t>(grid.n_nodes++);
      grid.xyz_m.insert(grid.xyz_m.end(), mesh.points_m[point].begin(), mesh.points_m[point].end());
    }
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    for (const int i : gmsh_place) grid.cell_nodes.push_back(node_of_point[std::size_t(mesh.cell(c)[i])]);
  grid.volume_id = mesh.volume_id;
  add_boundary(groups_of_faces(mesh, node_of_point), grid);
  return grid;
}

}  // namespace fem
