#include "meshes/imported/rounded_edges.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "meshes/solids/cad_surfaces.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/values/refused.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

constexpr double reach_radii = 5;  // from the point of a notch to its edge

[[noreturn]] void refuse_notch(const PartNotch& notch, const std::string& what) {
  std::ostringstream text;
  text.precision(4);
  text << "the notch at (" << 1e3 * notch.at_m[0] << ", " << 1e3 * notch.at_m[1] << ", "
       << 1e3 * notch.at_m[2] << ") mm: " << what;
  throw GeometryRefused(text.str());
}

Point scaled(const Point& p, double factor) {
  return {factor * p[0], factor * p[1], factor * p[2]};
}

/// The curve next to a point, within the reach of its notch.
int curve_next_to(const PartNotch& notch, double unit_m) {
  const Point at = scaled(notch.at_m, 1 / unit_m);
  double least = std::numeric_limits<double>::max();
  int next = 0;
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto& curve : curves) {
    std::vector<int> surfaces, points;
    gmsh::model::getAdjacencies(1, curve.second, surfaces, points);
    if (surfaces.size() < 2 || !(measure_of(1, curve.second) > 0)) continue;  // a seam, a point of an axis
    std::vector<double> closest, parameter;
    gmsh::model::getClosestPoint(1, curve.second, {at[0], at[1], at[2]}, closest, parameter);
    const double away = length(minus({closest.at(0), closest.at(1), closest.at(2)}, at));
    if (away < least) {
      least = away;
      next = curve.second;
    }
  }
  if (!(least * unit_m <= reach_radii * notch.radius_m))
    refuse_notch(notch, "no edge is within five radii of that point; give a point on the edge");
  return next;
}

/// An end of a curve.
struct CurveEnd {
  int point = 0;
  Point outwards{};  ///< unit tangent, away from the curve
};

std::vector<CurveEnd> ends_of(int curve) {
  gmsh::vectorpair points;
  gmsh::model::getBoundary({{1, curve}}, points, false, true, false);
  std::vector<double> begin, end;
  gmsh::model::getParametrizationBounds(1, curve, begin, end);
  std::vector<CurveEnd> ends;
  for (std::size_t i = 0; i < points.size() && i < 2; ++i) {
    std::vector<double> tangent;
    gmsh::model::getDerivative(1, curve, i == 0 ? begin : end, tangent);
    const Point along{tangent.at(0), tangent.at(1), tangent.at(2)};
    const double size = length(along);
    if (size > 0) ends.push_back({std::abs(points[i].second), scaled(along, (i == 0 ? -1 : 1) / size)});
  }
  return ends;
}

/// The curve and those that go on from it without a kink, as OpenCASCADE rounds them together.
std::vector<int> chain_from(int first) {
  constexpr double no_kink = 0.9999;  // cosine of 0.8 degrees
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  std::vector<int> chain{first};
  std::set<int> known{first};
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (const auto& end : ends_of(chain[i]))
      for (const auto& [dimension, curve] : curves)
        for (const auto& other : ends_of(curve))
          if (other.point == end.point && dot(other.outwards, end.outwards) < -no_kink &&
              known.insert(curve).second)
            chain.push_back(curve);
  return chain;
}

std::vector<Point> course_of(int curve, double unit_m) {
  constexpr int n_pieces = 32;
  std::vector<double> begin, end, at;
  gmsh::model::getParametrizationBounds(1, curve, begin, end);
  std::vector<Point> course;
  for (int i = 0; i <= n_pieces; ++i) {
    gmsh::model::getValue(1, curve, {begin.at(0) + i * (end.at(0) - begin[0]) / n_pieces}, at);
    course.push_back(scaled({at.at(0), at.at(1), at.at(2)}, unit_m));
  }
  return course;
}

int only_volume(const PartNotch& notch) {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  if (volumes.size() != 1)
    refuse_notch(notch, "edges are rounded on one solid, and the file has " + std::to_string(volumes.size()) +
                            ": unite them in the CAD");
  return volumes.front().second;
}

/// Rounds curves of a volume; nothing of the model changes but that volume, if it is not kept.
int rounded_volume(int volume, const std::vector<int>& curves, const std::vector<double>& radii, bool keep) {
  gmsh::vectorpair made;
  gmsh::model::occ::fillet({volume}, curves, radii, made, !keep);
  if (made.size() != 1 || made.front().first != 3) throw std::runtime_error("no solid is left");
  return made.front().second;
}

/// An inner edge gains volume when it is rounded, an outer one loses it.
void require_inner(const PartNotch& notch, int volume, int curve, double unit_m) {
  double gain = 0;
  try {
    const int tried = rounded_volume(volume, {curve}, {notch.radius_m / unit_m}, true);
    gain = measure_of(3, tried) - measure_of(3, volume);
    gmsh::model::occ::remove({{3, tried}}, true);
  } catch (...) {  // gmsh throws a text or an exception, by its version
    std::ostringstream radius;
    radius << 1e3 * notch.radius_m;
    refuse_notch(notch, "OpenCASCADE does not round the edge there by " + radius.str() +
                            " mm: round it in the CAD, or have its hot-spot stress read (kind = \"weld\")");
  }
  if (!(gain > 0))
    refuse_notch(notch, "the edge there is an outer one, which is no notch; give a point on the inner edge");
}

double distance_m(const std::vector<Point>& course_m, const Point& p_m) {
  double least_m = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < course_m.size(); ++i) {
    const Point along = minus(course_m[i + 1], course_m[i]), to = minus(p_m, course_m[i]);
    const double size = dot(along, along), share = size > 0 ? dot(to, along) / size : 0;
    least_m = std::min(least_m, length(minus(to, scaled(along, std::clamp(share, 0.0, 1.0)))));
  }
  return least_m;
}

/// Whether all curves around a surface stay near the course of an edge.
bool is_along(int surface, const std::vector<Point>& course_m, double near_m, double unit_m) {
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, surface}}, curves, false, false, false);
  for (const auto& curve : curves)
    for (const auto& point_m : course_of(curve.second, unit_m))
      if (!(distance_m(course_m, point_m) <= near_m)) return false;
  return !curves.empty();
}

/// The surfaces of the radius around the edge as it was: they begin r / tan(angle / 2) from it, four radii
/// where it opens by 28 degrees.
std::vector<int> surfaces_of(const PartNotch& notch, const std::vector<Point>& course_m, double unit_m) {
  constexpr double farthest_radii = 4, same_radius = 1e-3;
  std::vector<int> found;
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& surface : surfaces) {
    const double radius_m = unit_m * recognise(surface.second).radius;
    if (std::abs(radius_m - notch.radius_m) < same_radius * notch.radius_m &&
        is_along(surface.second, course_m, farthest_radii * notch.radius_m, unit_m))
      found.push_back(surface.second);
  }
  if (found.empty())
    refuse_notch(notch, "what OpenCASCADE rounds there is no surface of that radius: round it in the CAD");
  return found;
}

}  // namespace

std::vector<RoundedEdge> round_edges(const std::vector<PartNotch>& notches, double unit_m) {
  std::vector<RoundedEdge> rounded;
  std::vector<int> curves;
  std::vector<double> radii;
  for (const auto& notch : notches) {
    const int volume = only_volume(notch);
    RoundedEdge edge;
    for (const int curve : chain_from(curve_next_to(notch, unit_m))) {
      if (edge.course_m.empty()) require_inner(notch, volume, curve, unit_m);
      const auto course_m = course_of(curve, unit_m);
      edge.course_m.insert(edge.course_m.end(), course_m.begin(), course_m.end());
      if (std::find(curves.begin(), curves.end(), curve) != curves.end())
        refuse_notch(notch, "its edge is that of another notch: remove one of them");
      curves.push_back(curve);
      radii.push_back(notch.radius_m / unit_m);
    }
    rounded.push_back(std::move(edge));
  }
  if (notches.empty()) return rounded;
  try {
    rounded_volume(only_volume(notches.front()), curves, radii, false);
  } catch (...) {
    refuse_notch(notches.front(), "OpenCASCADE rounds this edge, but not all " +
                                      std::to_string(notches.size()) +
                                      " of the scene together: give fewer of them, or round them in the CAD");
  }
  gmsh::model::occ::synchronize();
  for (std::size_t i = 0; i < notches.size(); ++i)
    rounded[i].surfaces = surfaces_of(notches[i], rounded[i].course_m, unit_m);
  return rounded;
}

void name_notches(const std::vector<PartNotch>& notches, const std::vector<RoundedEdge>& rounded,
                  ModelMesh& model) {
  for (std::size_t i = 0; i < rounded.size(); ++i)
    for (auto& piece : model.pieces)
      if (std::find(rounded[i].surfaces.begin(), rounded[i].surfaces.end(), piece.tag) !=
          rounded[i].surfaces.end()) {
        piece.shape = "effective notch " + std::to_string(i + 1) + ", " + piece.shape;
        piece.notch_radius_m = notches[i].radius_m;
        piece.notch_course_m = rounded[i].course_m;
      }
}

}  // namespace meshes
