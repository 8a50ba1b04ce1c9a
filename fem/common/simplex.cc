#include "fem/common/simplex.h"

namespace fem {

namespace {

using Edges = std::vector<std::array<int, 2>>;
const Edges tetrahedron_edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
const Edges triangle_edges = {{0, 1}, {1, 2}, {2, 0}};

/// With the barycentric coordinates L: corners L (2 L - 1), edges 4 L_i L_j.
std::vector<ShapeAt> quadratic(int dimension, const Edges& edges, const std::array<double, 3>& point) {
  std::vector<ShapeAt> barycentric(dimension + 1);
  barycentric[0].value = 1;
  for (int d = 0; d < dimension; ++d) {
    barycentric[0].value -= point[d];
    barycentric[0].gradient[d] = -1;
    barycentric[d + 1].value = point[d];
    barycentric[d + 1].gradient[d] = 1;
  }
  std::vector<ShapeAt> shapes;
  for (const auto& l : barycentric) {
    ShapeAt s{l.value * (2 * l.value - 1), {}};
    for (int d = 0; d < 3; ++d) s.gradient[d] = (4 * l.value - 1) * l.gradient[d];
    shapes.push_back(s);
  }
  for (const auto& edge : edges) {
    const auto &a = barycentric[edge[0]], &b = barycentric[edge[1]];
    ShapeAt s{4 * a.value * b.value, {}};
    for (int d = 0; d < 3; ++d) s.gradient[d] = 4 * (a.value * b.gradient[d] + b.value * a.gradient[d]);
    shapes.push_back(s);
  }
  return shapes;
}

}  // namespace

std::vector<ShapeAt> quadratic_tetrahedron(const std::array<double, 3>& point) {
  return quadratic(3, tetrahedron_edges, point);
}

std::vector<ShapeAt> quadratic_triangle(const std::array<double, 3>& point) {
  return quadratic(2, triangle_edges, point);
}

std::vector<std::array<double, 3>> tetrahedron_nodes() {
  std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& edge : tetrahedron_edges) {
    std::array<double, 3> middle{};
    for (int d = 0; d < 3; ++d) middle[d] = (points[edge[0]][d] + points[edge[1]][d]) / 2;
    points.push_back(middle);
  }
  return points;
}

}  // namespace fem
