#include "meshes/checks/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "meshes/values/refused.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

Point unit_edge(const Point& from, const Point& to) {
  const Point d = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return {d[0] / length, d[1] / length, d[2] / length};
}

}  // namespace

double scaled_jacobian(const HexMesh& mesh, const Hex& hex) {
  // The three neighbours of each corner, right-handed.
  static const int neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                       {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double smallest = 1;
  for (int i = 0; i < 8; ++i) {
    const Point& corner = mesh.points[hex.nodes[i]];
    const auto edge = [&](int k) { return unit_edge(corner, mesh.points[hex.nodes[neighbours[i][k]]]); };
    smallest = std::min(smallest, triple_product(edge(0), edge(1), edge(2)));
  }
  return smallest;
}

double aspect(const HexMesh& mesh, const Hex& hex) {
  static const int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& edge : edges) {
    const Point &a = mesh.points[hex.nodes[edge[0]]], &b = mesh.points[hex.nodes[edge[1]]];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest / shortest;
}

void summarise(std::vector<double> values, const std::function<std::vector<Point>(std::size_t)>& corners_of,
               MeshQuality& quality) {
  const auto worst = std::min_element(values.begin(), values.end());
  quality.min_scaled_jacobian = *worst;
  const auto corners = corners_of(std::size_t(worst - values.begin()));
  Point centre{};
  for (const Point& corner : corners)
    for (int d = 0; d < 3; ++d) centre[d] += corner[d] / double(corners.size());
  quality.worst_x_m = centre[0];
  quality.worst_y_m = centre[1];
  quality.worst_z_m = centre[2];
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  quality.median_scaled_jacobian = *middle;
}

void require_quality(const MeshQuality& quality, double wanted, const std::string& mesh,
                     const std::string& remedy) {
  if (quality.min_scaled_jacobian >= wanted) return;
  std::ostringstream text;
  text << mesh << ": the smallest scaled Jacobian is " << quality.min_scaled_jacobian << " at (x, y, z) = ("
       << quality.worst_x_m * 1e3 << ", " << quality.worst_y_m * 1e3 << ", " << quality.worst_z_m * 1e3
       << ") mm, wanted " << wanted << "; " << remedy;
  throw MeshRefused(text.str());
}

MeshQuality measure_quality(const HexMesh& mesh) {
  MeshQuality quality;
  quality.n_cells = mesh.hexes.size();
  quality.n_vertices = mesh.points.size();
  std::vector<double> values;
  for (const Hex& hex : mesh.hexes) values.push_back(scaled_jacobian(mesh, hex));

  for (const Hex& hex : mesh.hexes) quality.max_aspect = std::max(quality.max_aspect, aspect(mesh, hex));

  summarise(
      std::move(values),
      [&](std::size_t cell) {
        std::vector<Point> corners;
        for (const int node : mesh.hexes[cell].nodes) corners.push_back(mesh.points[node]);
        return corners;
      },
      quality);
  return quality;
}

}  // namespace meshes
