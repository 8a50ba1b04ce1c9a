#include "fem/stress/cells/surface_stress.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fem/base/values/vtk_order.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {
namespace {

/// n intervals along each edge of the reference face.
ReferencePoints even_points(CellShape shape, int n) {
  ReferencePoints points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (shape.is_tetrahedron() ? n - j : n); ++i)
      points.push_back({double(i) / n, double(j) / n, 0});
  return points;
}

/// The shape function of a node of Nodes::faces, by its place there.
std::size_t shape_of(CellShape shape, std::size_t place) {
  return shape.is_tetrahedron() ? place : std::size_t(vtk_quad_order(shape.degree)[place]);
}

using Vector3 = Eigen::Vector3d;

/// What a node away from the point weighs where another lies there.
constexpr double no_weight = 1e-9;

/// A point of a face and how it moves with the reference coordinates.
struct FaceMap {
  Vector3 at = Vector3::Zero();
  Eigen::Matrix<double, 3, 2> slope = Eigen::Matrix<double, 3, 2>::Zero();
};

FaceMap map_face(const Nodes& nodes, const NodeList& face, const std::array<double, 3>& at) {
  const auto shapes = tabulate_on_face(nodes.shape(), {at});
  FaceMap map;
  for (std::size_t v = 0; v < face.size(); ++v) {
    const auto i = shape_of(nodes.shape(), v);
    const Vector3 node(&nodes.xyz_m[3 * std::size_t(face[v])]);
    map.at += shapes.value[i] * node;
    for (std::size_t d = 0; d < 2; ++d) map.slope.col(Eigen::Index(d)) += shapes.gradient[i][d] * node;
  }
  return map;
}

/// The point of a face next to another: Gauss and Newton, within the face.
struct Nearest {
  std::array<double, 3> at{};
  double distance_m = 0;
};
Nearest nearest_on_face(const Nodes& nodes, const NodeList& face, const Vector3& wanted) {
  constexpr int most_steps = 20;
  constexpr double small_step = 1e-12;
  const bool is_triangle = nodes.shape().is_tetrahedron();
  const double middle = is_triangle ? 1.0 / 3 : 0.5;
  Nearest nearest{{middle, middle, 0}, 0};
  for (int step = 0; step < most_steps; ++step) {
    const auto map = map_face(nodes, face, nearest.at);
    const Eigen::Vector2d change =
        (map.slope.transpose() * map.slope).ldlt().solve(map.slope.transpose() * (wanted - map.at));
    double s = nearest.at[0] + change[0], t = nearest.at[1] + change[1];
    if (const double beyond = s + t - 1; is_triangle && beyond > 0) {
      s -= beyond / 2;
      t -= beyond / 2;
    }
    s = std::clamp(s, 0.0, 1.0);
    t = std::clamp(t, 0.0, 1.0);
    const double moved = std::max(std::abs(s - nearest.at[0]), std::abs(t - nearest.at[1]));
    nearest.at = {s, t, 0};
    if (moved < small_step) break;
  }
  nearest.distance_m = (map_face(nodes, face, nearest.at).at - wanted).norm();
  return nearest;
}

}  // namespace

PointOnBoundary point_on_boundary(const Nodes& nodes, const std::array<double, 3>& at_m, double off_m) {
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
    const auto shapes = tabulate_on_face(nodes.shape(), {nearest.at});
    found = {f, {}};
    for (std::size_t v = 0; v < face.size(); ++v)
      if (const double share = shapes.value[shape_of(nodes.shape(), v)]; std::abs(share) > no_weight)
        found.shares.push_back({std::size_t(face[v]), share});
    if (found.shares.size() == 1) found.shares.front().weight = 1;
  }
  return found;
}

std::vector<UnitStress> stress_on_faces_around_Pa(const UnitResponses& responses, std::size_t node, int n,
                                                  const std::vector<char>& left_out) {
  const auto& nodes = responses.nodes;
  const std::size_t n_channels = responses.channels.size();
  const auto shapes = tabulate_on_face(nodes.shape(), even_points(nodes.shape(), n));
  std::vector<UnitStress> stresses;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const auto is_left_out = [&](std::int32_t i) { return left_out[std::size_t(i)] != 0; };
    if (std::find(face.begin(), face.end(), std::int32_t(node)) == face.end() ||
        std::any_of(face.begin(), face.end(), is_left_out))
      continue;
    responses.bring({face.begin(), face.end()});
    for (std::size_t q = 0; q < std::size_t(shapes.n_points); ++q) {
      auto& stress = stresses.emplace_back(n_channels);
      for (std::size_t v = 0; v < face.size(); ++v) {
        const double share = shapes.value[q * face.size() + shape_of(nodes.shape(), v)];
        const double* of_node = responses.stress_anywhere_Pa(std::size_t(face[v]));
        for (std::size_t k = 0; k < n_channels; ++k)
          for (std::size_t c = 0; c < 6; ++c) stress[k][c] += share * of_node[6 * k + c];
      }
    }
  }
  return stresses;
}

}  // namespace fem
