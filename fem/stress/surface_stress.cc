#include "fem/stress/surface_stress.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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

using Vector3 = Eigen::Vector3d;

/// Of a node away from the point, where another lies there.
constexpr double no_weight = 1e-9;

/// A point of a face and how it moves with the reference coordinates.
struct FaceMap {
  Vector3 at = Vector3::Zero();
  Eigen::Matrix<double, 3, 2> slope = Eigen::Matrix<double, 3, 2>::Zero();
};

FaceMap map_face(const Nodes& nodes, const NodeList& face, const Point& at) {
  const auto on_edge = nodes_on_edge(nodes.degree);
  const auto x = lagrange(on_edge, at[0]), y = lagrange(on_edge, at[1]);
  const int* order = vtk_quad_order(nodes.degree);
  FaceMap map;
  for (std::size_t v = 0; v < face.size(); ++v) {
    const auto &a = x[std::size_t(order[v]) % on_edge.size()], &b = y[std::size_t(order[v]) / on_edge.size()];
    const Vector3 node(&nodes.xyz_m[3 * std::size_t(face.begin()[v])]);
    map.at += a.value * b.value * node;
    map.slope.col(0) += a.derivative * b.value * node;
    map.slope.col(1) += a.value * b.derivative * node;
  }
  return map;
}

/// The point of a face next to another: Gauss and Newton, within the face.
struct Nearest {
  Point at{};
  double distance_m = 0;
};
Nearest nearest_on_face(const Nodes& nodes, const NodeList& face, const Vector3& wanted) {
  constexpr int most_steps = 20;
  constexpr double small_step = 1e-12;
  Nearest nearest{{0.5, 0.5}, 0};
  for (int step = 0; step < most_steps; ++step) {
    const auto map = map_face(nodes, face, nearest.at);
    const Eigen::Vector2d change =
        (map.slope.transpose() * map.slope).ldlt().solve(map.slope.transpose() * (wanted - map.at));
    double moved = 0;
    for (int d = 0; d < 2; ++d) {
      const double before = nearest.at[std::size_t(d)];
      nearest.at[std::size_t(d)] = std::clamp(before + change[d], 0.0, 1.0);
      moved = std::max(moved, std::abs(nearest.at[std::size_t(d)] - before));
    }
    if (moved < small_step) break;
  }
  nearest.distance_m = (map_face(nodes, face, nearest.at).at - wanted).norm();
  return nearest;
}

}  // namespace

PointOnBoundary point_on_boundary(const Nodes& nodes, const std::array<double, 3>& at_m, double off_m) {
  if (nodes.shape().is_tetrahedron()) return {};
  const Vector3 wanted(at_m.data());
  const auto node_at = [&](std::int32_t i) { return Vector3(&nodes.xyz_m[3 * std::size_t(i)]); };
  PointOnBoundary found;
  double least_m = off_m;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const Vector3 corner = node_at(face.begin()[0]);
    double size_m = 0;
    for (const auto i : face) size_m = std::max(size_m, (node_at(i) - corner).norm());
    if ((wanted - corner).norm() > 1.5 * size_m) continue;
    const auto nearest = nearest_on_face(nodes, face, wanted);
    if (nearest.distance_m >= least_m) continue;
    least_m = nearest.distance_m;
    const auto shapes = face_shapes(nodes.shape(), nearest.at);
    found = {f, {}};
    for (std::size_t v = 0; v < face.size(); ++v)
      if (std::abs(shapes[v]) > no_weight) found.shares.push_back({std::size_t(face.begin()[v]), shapes[v]});
    if (found.shares.size() == 1) found.shares.front().weight = 1;
  }
  return found;
}

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
