#include "fem/stress/surface_stress.h"

#include <algorithm>
#include <cstdint>

#include "fem/common/lagrange.h"
#include "fem/common/simplex.h"
#include "fem/values/vtk_order.h"

namespace fem {
namespace {

using Point = std::array<double, 2>;  // of the reference face

std::vector<Point> even_points(CellShape shape, int n) {
  std::vector<Point> points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (shape.is_tetrahedron() ? n - j : n); ++i)
      points.push_back({double(i) / n, double(j) / n});
  return points;
}

/// Shape functions of a face, in the order of Nodes::faces.
std::vector<double> face_shapes(CellShape shape, const Point& at) {
  std::vector<double> values;
  if (shape.is_tetrahedron()) {
    for (const auto& function : quadratic_triangle({at[0], at[1], 0})) values.push_back(function.value);
    return values;
  }
  const auto nodes = nodes_on_edge(shape.degree);
  const auto x = lagrange(nodes, at[0]), y = lagrange(nodes, at[1]);
  const int* order = vtk_quad_order(shape.degree);
  for (std::size_t v = 0; v < nodes.size() * nodes.size(); ++v)
    values.push_back(x[std::size_t(order[v]) % nodes.size()].value *
                     y[std::size_t(order[v]) / nodes.size()].value);
  return values;
}

}  // namespace

std::vector<UnitStress> stress_on_faces_around_Pa(const UnitResponses& responses, std::size_t node, int n,
                                                  const std::vector<char>& left_out) {
  const auto& nodes = responses.nodes;
  const std::size_t n_channels = responses.channels.size();
  std::vector<std::vector<double>> shapes;
  for (const auto& point : even_points(nodes.shape(), n)) shapes.push_back(face_shapes(nodes.shape(), point));
  std::vector<UnitStress> stresses;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const auto is_left_out = [&](std::int32_t i) { return left_out[std::size_t(i)] != 0; };
    if (std::find(face.begin(), face.end(), std::int32_t(node)) == face.end() ||
        std::any_of(face.begin(), face.end(), is_left_out))
      continue;
    for (const auto& values : shapes) {
      auto& stress = stresses.emplace_back(n_channels);
      for (std::size_t v = 0; v < face.size(); ++v) {
        const double* of_node = &responses.stress_Pa[6 * n_channels * std::size_t(face.begin()[v])];
        for (std::size_t k = 0; k < n_channels; ++k)
          for (std::size_t c = 0; c < 6; ++c) stress[k][c] += values[v] * of_node[6 * k + c];
      }
    }
  }
  return stresses;
}

}  // namespace fem
