/// A small body for the tests of result files: one row of triquadratic hexahedra through a smooth map.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "fem/unit_responses.h"
#include "fem/vtk_order.h"

namespace results_test {

using Point = std::array<double, 3>;

/// nx x ny x nz cells of the unit cube, seen through `map`; nodes lexicographic, x fastest; the boundary ids
/// 0 to 5 are x = 0, x = 1, y = 0, y = 1, z = 0, z = 1.
inline fem::Nodes mapped_cube(int nx, int ny, int nz, const std::function<Point(Point)>& map) {
  const std::array<int, 3> n_nodes = {2 * nx + 1, 2 * ny + 1, 2 * nz + 1};
  const auto number = [&](std::array<int, 3> i) { return i[0] + n_nodes[0] * (i[1] + n_nodes[1] * i[2]); };
  fem::Nodes nodes;
  for (int k = 0; k < n_nodes[2]; ++k)
    for (int j = 0; j < n_nodes[1]; ++j)
      for (int i = 0; i < n_nodes[0]; ++i)
        for (const double x : map({i / (2. * nx), j / (2. * ny), k / (2. * nz)})) nodes.xyz_m.push_back(x);
  nodes.n = nodes.xyz_m.size() / 3;
  nodes.volume_m3.assign(nodes.n, 1. / static_cast<double>(nodes.n));
  for (int ez = 0; ez < nz; ++ez)
    for (int ey = 0; ey < ny; ++ey)
      for (int ex = 0; ex < nx; ++ex) {
        auto& cell = nodes.cells.emplace_back();
        for (int v = 0; v < 27; ++v) {
          const int l = fem::vtk_hexahedron_from_lexicographic[static_cast<std::size_t>(v)];
          cell[static_cast<std::size_t>(v)] = number({2 * ex + l % 3, 2 * ey + l / 3 % 3, 2 * ez + l / 9});
        }
      }
  const std::array<int, 3> n_cells = {nx, ny, nz};
  for (int side = 0; side < 6; ++side) {
    const int normal = side / 2, a = normal == 0 ? 1 : 0, b = normal == 2 ? 1 : 2;
    for (int eb = 0; eb < n_cells[b]; ++eb)
      for (int ea = 0; ea < n_cells[a]; ++ea) {
        auto& face = nodes.faces.emplace_back();
        nodes.face_boundary_id.push_back(side);
        for (int v = 0; v < 9; ++v) {
          const int l = fem::vtk_quad_from_lexicographic[static_cast<std::size_t>(v)];
          std::array<int, 3> i{};
          i[normal] = side % 2 ? n_nodes[normal] - 1 : 0;
          i[a] = 2 * ea + l % 3;
          i[b] = 2 * eb + l / 3;
          face[static_cast<std::size_t>(v)] = number(i);
        }
      }
  }
  return nodes;
}

/// A map of degree two in each coordinate without any symmetry: a wrong order of nodes shows.
inline Point quadratic_map(Point p) {
  const auto [x, y, z] = p;
  return {2 * x + 0.2 * y * y + 0.1 * x * x * z, 1.5 * y + 0.15 * z * z * x + 0.1 * y * y * z * z,
          z + 0.1 * x * x * y * y - 0.2 * z * z * y};
}

}  // namespace results_test
