#include "meshes/checks/curved_quality.h"

#include <algorithm>
#include <cmath>

#include "meshes/checks/quality.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

/// Columns of dx/dxi of a quadratic tetrahedron at barycentric coordinates.
std::array<Point, 3> tangents(const CellMesh& mesh, const int* nodes, const std::array<double, 4>& at) {
  static const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}};  // gmsh's order
  std::array<Point, 4> by_barycentric{};                                            // dx/dL
  for (int i = 0; i < 4; ++i)
    for (int d = 0; d < 3; ++d) by_barycentric[i][d] = (4 * at[i] - 1) * mesh.points[nodes[i]][d];
  for (int e = 0; e < 6; ++e)
    for (int d = 0; d < 3; ++d) {
      const double x = 4 * mesh.points[nodes[4 + e]][d];
      by_barycentric[edges[e][0]][d] += at[edges[e][1]] * x;
      by_barycentric[edges[e][1]][d] += at[edges[e][0]] * x;
    }
  std::array<Point, 3> result;
  for (int i = 0; i < 3; ++i) result[i] = minus(by_barycentric[i + 1], by_barycentric[0]);
  return result;
}

double scaled_at(const std::array<Point, 3>& t) {
  const double a = length(t[0]), b = length(t[1]), c = length(t[2]), ab = length(minus(t[1], t[0])),
               bc = length(minus(t[2], t[1])), ca = length(minus(t[0], t[2]));
  const double product = std::max({a * b * c, a * ab * ca, b * ab * bc, c * bc * ca});
  return product > 0 ? std::sqrt(2.0) * triple_product(t[0], t[1], t[2]) / product : 0;
}

double scaled_tetrahedron(const CellMesh& mesh, const int* nodes) {
  double smallest = 1;
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
      for (int k = 0; i + j + k <= 3; ++k)
        smallest = std::min(
            smallest, scaled_at(tangents(mesh, nodes, {i / 3.0, j / 3.0, k / 3.0, (3 - i - j - k) / 3.0})));
  return smallest;
}

/// Longest edge over shortest, from corner to corner.
double aspect(const CellMesh& mesh, const int* nodes) {
  double shortest = 0, longest = 0;
  for (const auto& face : local_faces(mesh.kind))
    for (std::size_t i = 0; i < mesh.corners_per_face(); ++i) {
      const double edge = length(
          minus(mesh.points[nodes[face[i]]], mesh.points[nodes[face[(i + 1) % mesh.corners_per_face()]]]));
      shortest = longest == 0 ? edge : std::min(shortest, edge);
      longest = std::max(longest, edge);
    }
  return longest / shortest;
}

}  // namespace

double scaled_jacobian(const CellMesh& mesh, std::size_t cell) {
  const int* nodes = mesh.cell(cell);
  if (mesh.kind == CellKind::tetrahedra) return scaled_tetrahedron(mesh, nodes);
  HexMesh one;
  Hex hex;
  for (int i = 0; i < 8; ++i) {
    one.points.push_back(mesh.points[nodes[i]]);
    hex.nodes[i] = i;
  }
  return scaled_jacobian(one, hex);
}

MeshQuality measure_quality(const CellMesh& mesh) {
  MeshQuality quality;
  quality.n_cells = mesh.n_cells();
  quality.n_vertices = mesh.points.size();
  std::vector<double> values;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c) {
    values.push_back(scaled_jacobian(mesh, c));
    quality.max_aspect = std::max(quality.max_aspect, aspect(mesh, mesh.cell(c)));
  }
  summarise(
      std::move(values),
      [&](std::size_t cell) {
        std::vector<Point> corners;
        for (int i = 0; i < (mesh.kind == CellKind::tetrahedra ? 4 : 8); ++i)
          corners.push_back(mesh.points[mesh.cell(cell)[i]]);
        return corners;
      },
      quality);
  return quality;
}

}  // namespace meshes
