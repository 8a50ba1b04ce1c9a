#include "meshes/solids/cad_surfaces.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "meshes/values/constants.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

constexpr double same_direction = 1e-7;  // sine of the angle between normals of a plane
// Share of the radius: splines through points of a cylinder are off by that.
constexpr double same_radius = 1e-5;

struct Sample {
  Point at{}, normal{};
  double curvature = 0;  // the larger one of the two principal ones, by size
};

/// A grid over the surface's parameters, which may reach beyond its trimmed edges.
std::vector<Sample> samples_of(int surface) {
  std::vector<double> low, high, places, points, normals, most, least, directions, others;
  gmsh::model::getParametrizationBounds(2, surface, low, high);
  if (low.size() < 2 || high.size() < 2) return {};
  for (const double u : {0.06, 0.29, 0.48, 0.73, 0.91})
    for (const double v : {0.08, 0.27, 0.53, 0.71, 0.94}) {
      places.push_back(low[0] + u * (high[0] - low[0]));
      places.push_back(low[1] + v * (high[1] - low[1]));
    }
  gmsh::model::getValue(2, surface, places, points);
  gmsh::model::getNormal(surface, places, normals);
  gmsh::model::getPrincipalCurvatures(surface, places, most, least, directions, others);
  const std::size_t n = places.size() / 2;
  if (points.size() != 3 * n || normals.size() != 3 * n || most.size() != n || least.size() != n) return {};
  std::vector<Sample> samples(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::copy_n(&points[3 * i], 3, samples[i].at.begin());
    std::copy_n(&normals[3 * i], 3, samples[i].normal.begin());
    samples[i].curvature = std::max(std::abs(most[i]), std::abs(least[i]));
    const double size = length(samples[i].normal);
    if (!std::isfinite(samples[i].curvature) || !(size > 0)) return {};
    for (double& x : samples[i].normal) x /= size;
  }
  return samples;
}

Point along(const Point& from, double by, const Point& direction) {
  return {from[0] + by * direction[0], from[1] + by * direction[1], from[2] + by * direction[2]};
}

double extent_of(const std::vector<Sample>& samples) {
  double extent = 0;
  for (const auto& sample : samples) extent = std::max(extent, length(minus(sample.at, samples[0].at)));
  return extent;
}

bool is_plane(const std::vector<Sample>& samples) {
  const auto& first = samples.front();
  const double near = same_direction * extent_of(samples);
  return std::all_of(samples.begin(), samples.end(), [&](const Sample& sample) {
    return length(cross(sample.normal, first.normal)) < same_direction &&
           std::abs(dot(minus(sample.at, first.at), first.normal)) < near;
  });
}

std::optional<CadSurface> as_cylinder(const std::vector<Sample>& samples) {
  const auto& first = samples.front();
  const auto across = *std::max_element(samples.begin(), samples.end(), [&](const auto& a, const auto& b) {
    return length(cross(a.normal, first.normal)) < length(cross(b.normal, first.normal));
  });
  CadSurface cylinder;
  cylinder.kind = CadSurface::Kind::cylinder;
  cylinder.axis = cross(first.normal, across.normal);
  const double size = length(cylinder.axis);
  if (!(size > 1e-3)) return std::nullopt;
  for (double& x : cylinder.axis) x /= size;
  const Point turned = minus(across.normal, first.normal);
  const double radius = dot(minus(across.at, first.at), turned) / dot(turned, turned);  // signed by normals
  cylinder.centre = along(first.at, -radius, first.normal);
  cylinder.radius = std::abs(radius);
  for (const auto& sample : samples) {
    const Point arm = minus(sample.at, cylinder.centre);
    const Point off = along(along(arm, -dot(arm, cylinder.axis), cylinder.axis), -radius, sample.normal);
    if (!(length(off) < same_radius * cylinder.radius)) return std::nullopt;
  }
  return cylinder;
}

/// Two directions across a third.
std::pair<Point, Point> across(const Point& axis) {
  const int least = std::abs(axis[0]) < std::abs(axis[1]) ? (std::abs(axis[0]) < std::abs(axis[2]) ? 0 : 2)
                                                          : (std::abs(axis[1]) < std::abs(axis[2]) ? 1 : 2);
  Point unit{};
  unit[std::size_t(least)] = 1;
  Point first = cross(axis, unit);
  const double size = length(first);
  for (double& x : first) x /= size;
  return {first, cross(axis, first)};
}

/// Area, its first moments in the surface's own axes, and the angle that an edge goes around a cylinder.
using Sums = std::array<double, 5>;

void add(Sums& sums, double factor, const Sums& others) {
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += factor * others[k];
}

/// What a piece of curve adds by Green's theorem: integrals over the surface become ones along its edge.
struct Integrand {
  int curve;
  const CadSurface& shape;
  Point first, second;

  Sums operator()(double t) const {
    std::vector<double> at, tangent;
    gmsh::model::getValue(1, curve, {t}, at);
    gmsh::model::getDerivative(1, curve, {t}, tangent);
    const Point x{at[0] - shape.centre[0], at[1] - shape.centre[1], at[2] - shape.centre[2]},
        dx{tangent[0], tangent[1], tangent[2]};
    const double a = dot(x, first), b = dot(x, second), c = dot(x, shape.axis);
    const double da = dot(dx, first), db = dot(dx, second);
    if (shape.kind == CadSurface::Kind::plane)
      return {(a * db - b * da) / 2, a * a * db / 2, -b * b * da / 2, 0, 0};
    const double turn = (a * db - b * da) / shape.radius;  // radius times the angle's derivative
    return {-c * turn, -c * a * turn, -c * b * turn, -c * c * turn / 2, turn / shape.radius};
  }
};

/// Gauss's rule of five points.
Sums integral(const Integrand& f, double begin, double end) {
  constexpr double x[] = {0.0, 0.5384693101056831, 0.9061798459386640},
                   w[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = (begin + end) / 2, half = (end - begin) / 2;
  Sums sums{};
  for (int i = 0; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) {
      if (i == 0 && side > 0) continue;
      add(sums, half * w[i], f(middle + side * half * x[i]));
    }
  return sums;
}

/// Halved where the rule is not exact: at the knots of splines.
Sums refined(const Integrand& f, double begin, double end, const Sums& whole, const Sums& tolerance,
             int depth) {
  const double middle = (begin + end) / 2;
  const Sums left = integral(f, begin, middle), right = integral(f, middle, end);
  bool is_exact = true;
  Sums sums{};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k] = left[k] + right[k];
    is_exact = is_exact && std::abs(sums[k] - whole[k]) <= tolerance[k];
  }
  if (is_exact || depth == 0) return sums;
  const Sums a = refined(f, begin, middle, left, tolerance, depth - 1),
             b = refined(f, middle, end, right, tolerance, depth - 1);
  sums = a;
  add(sums, 1, b);
  return sums;
}

Sums along_curve(const Integrand& f, double size) {
  constexpr int n_pieces = 8, most_halvings = 30;
  constexpr double precision = 1e-13;
  const double area_near = precision * size * size, moment_near = area_near * size;
  const Sums tolerance{area_near, moment_near, moment_near, moment_near, precision};
  std::vector<double> begin, end;
  gmsh::model::getParametrizationBounds(1, f.curve, begin, end);
  Sums sums{};
  for (int i = 0; i < n_pieces; ++i) {
    const double a = begin.at(0) + i * (end.at(0) - begin[0]) / n_pieces,
                 b = begin[0] + (i + 1) * (end[0] - begin[0]) / n_pieces;
    add(sums, 1, refined(f, a, b, integral(f, a, b), tolerance, most_halvings));
  }
  return sums;
}

/// The curves around a surface, each loop in one sense: a curve that is passed backwards is negative. Seams,
/// which bound the surface on both sides, are left out. Empty where curves do not close.
std::vector<std::vector<int>> loops_of(int surface) {
  gmsh::vectorpair boundary;
  gmsh::model::getBoundary({{2, surface}}, boundary, false, false, false);
  std::map<int, int> n_passed;
  for (const auto& curve : boundary) ++n_passed[curve.second];
  std::map<int, std::pair<int, int>> open;  // curve, its points
  for (const auto& [curve, n] : n_passed) {
    gmsh::vectorpair points;
    gmsh::model::getBoundary({{1, curve}}, points, false, true, false);
    if (n == 1 && !points.empty())
      open[curve] = {std::abs(points.front().second), std::abs(points.back().second)};
  }
  std::vector<std::vector<int>> loops;
  while (!open.empty()) {
    const auto [curve, points] = *open.begin();
    open.erase(open.begin());
    loops.push_back({curve});
    for (int at = points.second; at != points.first;) {
      const auto next = std::find_if(open.begin(), open.end(), [&](const auto& other) {
        return other.second.first == at || other.second.second == at;
      });
      if (next == open.end()) return {};
      const bool forwards = next->second.first == at;
      loops.back().push_back(forwards ? next->first : -next->first);
      at = forwards ? next->second.second : next->second.first;
      open.erase(next);
    }
  }
  return loops;
}

std::string in_mm(double length_m) {
  constexpr double rounding_mm = 1e-6;
  std::ostringstream text;
  text.precision(5);
  const double mm = 1e3 * length_m;
  text << (std::abs(mm) < rounding_mm ? 0 : mm);
  return text.str();
}

}  // namespace

CadSurface recognise(int surface) {
  CadSurface result;
  const auto samples = samples_of(surface);
  if (samples.empty()) return result;
  if (is_plane(samples)) {
    result.kind = CadSurface::Kind::plane;
    result.centre = samples.front().at;
    result.axis = samples.front().normal;
    return result;
  }
  if (const auto cylinder = as_cylinder(samples)) return *cylinder;
  const auto [least, most] = std::minmax_element(
      samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.curvature < b.curvature; });
  constexpr double alike = 1e-3;
  if (least->curvature > (1 - alike) * most->curvature) {
    result.kind = CadSurface::Kind::bent;
    result.radius = 1 / most->curvature;
  }
  return result;
}

std::optional<AreaAndCentre> area_of(int surface, const CadSurface& shape) {
  if (shape.kind != CadSurface::Kind::plane && shape.kind != CadSurface::Kind::cylinder) return std::nullopt;
  double low[3], high[3];
  gmsh::model::getBoundingBox(2, surface, low[0], low[1], low[2], high[0], high[1], high[2]);
  const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  const auto [first, second] = across(shape.axis);
  std::vector<Sums> loops;
  for (const auto& loop : loops_of(surface)) {
    loops.emplace_back();
    for (const int curve : loop)
      add(loops.back(), curve > 0 ? 1 : -1, along_curve({std::abs(curve), shape, first, second}, size));
  }
  if (loops.empty()) return std::nullopt;
  // The file's own sense of each loop is not told: those around a cylinder bound it on both sides, and of the
  // others the largest one is outside, but for these.
  const auto is_around = [](const Sums& loop) { return std::abs(loop[4]) > pi; };
  const auto n_around = std::count_if(loops.begin(), loops.end(), is_around);
  if (n_around != 0 && n_around != 2) return std::nullopt;
  const auto outer = std::max_element(loops.begin(), loops.end(), [](const Sums& a, const Sums& b) {
    return std::abs(a[0]) < std::abs(b[0]);
  });
  Sums sums{};
  for (const auto& loop : loops)  // both about the axis the same way, less each other
    if (is_around(loop)) add(sums, (sums[4] == 0 ? 1 : -1) * (loop[4] > 0 ? 1 : -1), loop);
  if (sums[0] < 0) add(sums, -2, Sums(sums));
  for (auto loop = loops.begin(); loop != loops.end(); ++loop)
    if (!is_around(*loop))
      add(sums, (n_around == 0 && loop == outer ? 1 : -1) * ((*loop)[0] > 0 ? 1 : -1), *loop);
  if (!(sums[0] > 0)) return std::nullopt;
  AreaAndCentre result{sums[0], shape.centre};
  result.centre = along(result.centre, sums[1] / sums[0], first);
  result.centre = along(result.centre, sums[2] / sums[0], second);
  result.centre = along(result.centre, sums[3] / sums[0], shape.axis);
  return result;
}

namespace {

/// How far the middle of each piece's edges lies outside: above 0 where the body is convex, below where it is
/// hollow.
std::vector<double> bulges_of(const ModelMesh& model) {
  std::vector<double> bulges(model.pieces.size(), 0.0);
  const CellMesh& mesh = model.mesh;
  for (std::size_t f = 0; mesh.kind == CellKind::tetrahedra && f < mesh.n_faces(); ++f) {
    const int* nodes = mesh.face(f);
    const auto at = [&](int i) { return mesh.points[std::size_t(nodes[i])]; };
    const Point normal = cross(minus(at(1), at(0)), minus(at(2), at(0)));  // outward
    for (int i = 0; i < 3; ++i) {
      const Point a = minus(at(3 + i), at(i)), b = minus(at(3 + i), at((i + 1) % 3));
      bulges[std::size_t(mesh.face_id[f])] += dot(normal, a) + dot(normal, b);
    }
  }
  return bulges;
}

std::string shape_of(const Piece& piece, double bulge, double unit_m, const Point& origin_m) {
  // The centre of half a cylinder lies 0.64 radii from its axis, that of a fillet's quarter 0.9.
  constexpr double round = 0.75, straight = 1 - 1e-9;
  const auto shape = recognise(piece.tag);
  if (shape.kind == CadSurface::Kind::plane) {
    const char* const axes[] = {"x", "y", "z"};
    for (std::size_t d = 0; d < 3; ++d)
      if (std::abs(shape.axis[d]) > straight)
        return std::string("plane ") + axes[d] + " = " + in_mm(unit_m * shape.centre[d] + origin_m[d]) +
               " mm";
    return "plane";
  }
  if (shape.kind == CadSurface::Kind::other) return "";
  if (shape.kind == CadSurface::Kind::cylinder) {
    Point arm_m = piece.centre_m;
    for (std::size_t d = 0; d < 3; ++d) arm_m[d] -= unit_m * shape.centre[d];
    if (length(cross(arm_m, shape.axis)) < round * unit_m * shape.radius)
      return (bulge < 0 ? "hole d " : "cylinder d ") + in_mm(2 * unit_m * shape.radius) + " mm";
  }
  return (bulge < 0 ? "fillet r " : "rounding r ") + in_mm(unit_m * shape.radius) + " mm";
}

}  // namespace

void name_shapes(double unit_m, const Point& origin_m, ModelMesh& model) {
  const auto bulges = bulges_of(model);
  for (std::size_t i = 0; i < model.pieces.size(); ++i)
    if (model.pieces[i].tag != 0)
      model.pieces[i].shape = shape_of(model.pieces[i], bulges[i], unit_m, origin_m);
}

}  // namespace meshes
