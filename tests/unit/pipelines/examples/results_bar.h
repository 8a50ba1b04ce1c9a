/// A small body for the tests of result files: one row of triquadratic hexahedra through a smooth map.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/base/values/vtk_order.h"

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
        std::array<std::int32_t, 27> cell;
        for (int v = 0; v < 27; ++v) {
          const int l = fem::vtk_hexahedron_from_lexicographic[static_cast<std::size_t>(v)];
          cell[static_cast<std::size_t>(v)] = number({2 * ex + l % 3, 2 * ey + l / 3 % 3, 2 * ez + l / 9});
        }
        nodes.cells.insert(nodes.cells.end(), cell.begin(), cell.end());
      }
  const std::array<int, 3> n_cells = {nx, ny, nz};
  for (int side = 0; side < 6; ++side) {
    const int normal = side / 2, a = normal == 0 ? 1 : 0, b = normal == 2 ? 1 : 2;
    for (int eb = 0; eb < n_cells[b]; ++eb)
      for (int ea = 0; ea < n_cells[a]; ++ea) {
        std::array<std::int32_t, 9> face;
        nodes.face_boundary_id.push_back(side);
        for (int v = 0; v < 9; ++v) {
          const int l = fem::vtk_quad_from_lexicographic[static_cast<std::size_t>(v)];
          std::array<int, 3> i{};
          i[normal] = side % 2 ? n_nodes[normal] - 1 : 0;
          i[a] = 2 * ea + l % 3;
          i[b] = 2 * eb + l / 3;
          face[static_cast<std::size_t>(v)] = number(i);
        }
        nodes.faces.insert(nodes.faces.end(), face.begin(), face.end());
      }
  }
  return nodes;
}

/// The unit cube in six quadratic tetrahedra from its corner 0 to its corner (1, 1, 1), seen through `map`;
/// the 27 nodes lexicographic; boundary id 3.
inline fem::Nodes mapped_tetrahedra(const std::function<Point(Point)>& map) {
  using Place = std::array<int, 3>;  // in half edges of the cube
  fem::Nodes nodes;
  nodes.kind = fem::CellKind::tetrahedra;
  nodes.n = 27;
  nodes.volume_m3.assign(27, 1. / 27);
  for (int i = 0; i < 27; ++i)
    for (const double x : map({i % 3 / 2., i / 3 % 3 / 2., i / 9 / 2.})) nodes.xyz_m.push_back(x);
  const auto number = [](const Place& a) { return a[0] + 3 * a[1] + 9 * a[2]; };
  const auto middle = [&](const Place& a, const Place& b) {
    return number({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  };
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int t = 0; t < 6; ++t) {
    std::array<Place, 4> c{};
    for (std::size_t step = 0; step < 3; ++step) {
      c[step + 1] = c[step];
      c[step + 1][std::size_t(orders[t][step])] = 2;
    }
    if (t >= 3) std::swap(c[1], c[2]);  // right-handed
    for (const auto& corner : c) nodes.cells.push_back(number(corner));
    const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (const auto& e : edges) nodes.cells.push_back(middle(c[std::size_t(e[0])], c[std::size_t(e[1])]));
    const int outer[2][3] = {{1, 2, 3}, {0, 2, 1}};  // the faces without corner 0 and without (1, 1, 1)
    for (const auto& f : outer) {
      for (const int i : f) nodes.faces.push_back(number(c[std::size_t(i)]));
      for (int i = 0; i < 3; ++i)
        nodes.faces.push_back(middle(c[std::size_t(f[i])], c[std::size_t(f[(i + 1) % 3])]));
      nodes.face_boundary_id.push_back(3);
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
