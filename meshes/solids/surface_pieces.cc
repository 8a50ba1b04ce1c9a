#include "meshes/solids/surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "meshes/values/vectors.h"

namespace meshes {

namespace {

struct Triangle {
  Point centre{}, normal{};  // normal of the length of the area, outward
};

/// The triangle of a face by its corners alone; a quadrangle by its two halves.
Triangle flat(const CellMesh& mesh, std::size_t face) {
  const int* nodes = mesh.face(face);
  const std::size_t n = mesh.corners_per_face();
  Triangle t;
  double area = 0;
  for (std::size_t half = 0; half + 2 < n; ++half) {
    const Point &a = mesh.points[nodes[0]], &b = mesh.points[nodes[half + 1]],
                &c = mesh.points[nodes[half + 2]];
    Point u, v;
    for (int k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    const Point normal = cross(u, v);
    const double its_area = length(normal) / 2;
    area += its_area;
    for (int k = 0; k < 3; ++k) {
      t.normal[k] += normal[k] / 2;
      t.centre[k] += its_area * (a[k] + b[k] + c[k]) / 3;
    }
  }
  for (double& x : t.centre) x /= area;
  return t;
}

struct Patch {
  double area = 0;
  Point moment{};  // area times centre
};

/// A face of quadratic tetrahedra with its curved edges, by Radon's rule of degree 5 (exact where it is
/// flat).
Patch curved(const CellMesh& mesh, const int* nodes) {
  const double root = std::sqrt(15.0), a = (6 - root) / 21, b = (6 + root) / 21;
  const double weight_a = (155 - root) / 2400, weight_b = (155 + root) / 2400;
  const double points[7][3] = {{1.0 / 3, 1.0 / 3, 9.0 / 80}, {a, a, weight_a}, {1 - 2 * a, a, weight_a},
                               {a, 1 - 2 * a, weight_a},     {b, b, weight_b}, {1 - 2 * b, b, weight_b},
                               {b, 1 - 2 * b, weight_b}};
  Patch patch;
  for (const auto& [u, v, weight] : points) {
    const double w = 1 - u - v;
    const double shape[6] = {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1),
                             4 * w * u,       4 * u * v,       4 * v * w};
    const double along_u[6] = {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v};
    const double along_v[6] = {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)};
    Point x{}, x_u{}, x_v{};
    for (int i = 0; i < 6; ++i)
      for (int d = 0; d < 3; ++d) {
        x[d] += shape[i] * mesh.points[nodes[i]][d];
        x_u[d] += along_u[i] * mesh.points[nodes[i]][d];
        x_v[d] += along_v[i] * mesh.points[nodes[i]][d];
      }
    const double area = weight * length(cross(x_u, x_v));
    patch.area += area;
    for (int d = 0; d < 3; ++d) patch.moment[d] += area * x[d];
  }
  return patch;
}

Patch patch_of(const CellMesh& mesh, std::size_t face) {
  if (mesh.kind == CellKind::tetrahedra) return curved(mesh, mesh.face(face));
  const Triangle t = flat(mesh, face);
  const double area = length(t.normal);
  return {area, {area * t.centre[0], area * t.centre[1], area * t.centre[2]}};
}

/// Circle x^2 + y^2 = 2 a x + 2 b y + c by least squares, about the mean of the points.
std::optional<FoundCylinder> fit(const std::vector<Point>& points) {
  double mx = 0, my = 0;
  for (const auto& p : points) mx += p[0] / double(points.size()), my += p[1] / double(points.size());
  double xx = 0, xy = 0, yy = 0, xq = 0, yq = 0, q_mean = 0;
  for (const auto& p : points) {
    const double x = p[0] - mx, y = p[1] - my, q = x * x + y * y;
    xx += x * x, xy += x * y, yy += y * y, xq += x * q, yq += y * q;
    q_mean += q / double(points.size());
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-8 * (xx + yy) * (xx + yy))) return std::nullopt;  // as good as a plane
  const double a = (xq * yy - yq * xy) / (2 * determinant), b = (yq * xx - xq * xy) / (2 * determinant);
  FoundCylinder cylinder;
  cylinder.axis_x_m = mx + a;
  cylinder.axis_y_m = my + b;
  cylinder.radius_m = std::sqrt(q_mean + a * a + b * b);
  for (const auto& p : points)
    if (std::abs(std::hypot(p[0] - cylinder.axis_x_m, p[1] - cylinder.axis_y_m) - cylinder.radius_m) >
        1e-3 * cylinder.radius_m)
      return std::nullopt;
  return cylinder;
}

std::optional<FoundCylinder> cylinder_through(const CellMesh& mesh, const std::vector<std::size_t>& faces) {
  std::set<int> nodes;
  for (const auto f : faces) nodes.insert(mesh.face(f), mesh.face(f) + mesh.corners_per_face());
  std::vector<Point> points;
  for (const int node : nodes) points.push_back(mesh.points[node]);
  auto cylinder = points.size() < 4 ? std::nullopt : fit(points);
  if (!cylinder) return std::nullopt;
  int n_out = 0, n_in = 0;
  for (const auto f : faces) {
    const Triangle t = flat(mesh, f);
    const double x = t.centre[0] - cylinder->axis_x_m, y = t.centre[1] - cylinder->axis_y_m;
    const double along = (t.normal[0] * x + t.normal[1] * y) / (length(t.normal) * std::hypot(x, y));
    if (std::abs(along) < 0.8) return std::nullopt;  // not along the radius: coarse facets have 0.87 and more
    ++(along > 0 ? n_out : n_in);
  }
  if (n_out > 0 && n_in > 0) return std::nullopt;
  cylinder->inside = n_in > 0;
  return cylinder;
}

}  // namespace

std::vector<PieceShape> shapes_of(const CellMesh& mesh, const std::vector<int>& of_face, std::size_t n) {
  std::vector<PieceShape> shapes(n);
  std::vector<std::vector<std::size_t>> faces(n);
  for (auto& shape : shapes) {
    shape.low_m.fill(1e300);
    shape.high_m.fill(-1e300);
  }
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    auto& shape = shapes[of_face[f]];
    faces[of_face[f]].push_back(f);
    const Patch patch = patch_of(mesh, f);
    shape.area_m2 += patch.area;
    for (int d = 0; d < 3; ++d) {
      shape.centre_m[d] += patch.moment[d];
      for (std::size_t i = 0; i < mesh.corners_per_face(); ++i) {
        shape.low_m[d] = std::min(shape.low_m[d], mesh.points[mesh.face(f)[i]][d]);
        shape.high_m[d] = std::max(shape.high_m[d], mesh.points[mesh.face(f)[i]][d]);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (double& x : shapes[i].centre_m) x /= shapes[i].area_m2;
    shapes[i].cylinder = cylinder_through(mesh, faces[i]);
  }
  return shapes;
}

std::optional<FoundCylinder> common_cylinder(const CellMesh& mesh, const std::vector<int>& of_face,
                                             const std::vector<int>& pieces) {
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    if (std::find(pieces.begin(), pieces.end(), of_face[f]) != pieces.end()) faces.push_back(f);
  return cylinder_through(mesh, faces);
}

std::string describe(const PieceShape& shape) {
  std::ostringstream text;
  const auto mm = [](double x) { return std::abs(x) < 1e-12 ? 0 : x * 1e3; };
  text.precision(5);
  if (shape.cylinder)
    text << (shape.cylinder->inside ? "inside" : "outside") << " of radius " << mm(shape.cylinder->radius_m)
         << " mm about (" << mm(shape.cylinder->axis_x_m) << ", " << mm(shape.cylinder->axis_y_m)
         << ") mm, z = " << mm(shape.low_m[2]) << " to " << mm(shape.high_m[2]) << " mm";
  else
    text << "x = " << mm(shape.low_m[0]) << " to " << mm(shape.high_m[0]) << ", y = " << mm(shape.low_m[1])
         << " to " << mm(shape.high_m[1]) << ", z = " << mm(shape.low_m[2]) << " to " << mm(shape.high_m[2])
         << " mm";
  return text.str();
}

}  // namespace meshes
