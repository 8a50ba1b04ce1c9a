#include "meshes/checks/part_welds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "meshes/checks/reentrant_edges.h"
#include "meshes/values/refused.h"
#include "meshes/values/vectors.h"

namespace meshes {
namespace {

constexpr double near_walls = 0.4, far_walls = 1.0;
/// Share of the plate's thickness: a point that far off the face lies beyond its end, or the face is strongly
/// curved.
constexpr double off_face_walls = 0.02;

Point along(const Point& from, const Vector& direction, double distance) {
  Point p{};
  for (int d = 0; d < 3; ++d) p[d] = from[d] + distance * direction[d];
  return p;
}

Vector unit(const Vector& v) {
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

Point nearest_on_piece(const Point& p, const Point& a, const Point& b) {
  const Vector ab = minus(b, a);
  const double size = dot(ab, ab);
  return along(a, ab, size > 0 ? std::clamp(dot(minus(p, a), ab) / size, 0.0, 1.0) : 0.0);
}

Point nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vector n = unit(cross(minus(b, a), minus(c, a)));
  const Point foot = along(p, n, -dot(minus(p, a), n));
  const bool is_inside = triple_product(n, minus(b, a), minus(foot, a)) >= 0 &&
                         triple_product(n, minus(c, b), minus(foot, b)) >= 0 &&
                         triple_product(n, minus(a, c), minus(foot, c)) >= 0;
  if (is_inside) return foot;
  const Point on[] = {nearest_on_piece(p, a, b), nearest_on_piece(p, b, c), nearest_on_piece(p, c, a)};
  return *std::min_element(std::begin(on), std::end(on), [&](const Point& one, const Point& other) {
    return length(minus(p, one)) < length(minus(p, other));
  });
}

/// Nearest point on the flat faces of a group.
Point nearest_on_group(const CellMesh& mesh, int face_id, const Point& p) {
  Point nearest{};
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    if (mesh.face_id[f] != face_id) continue;
    const int* n = mesh.face(f);
    const Point on = nearest_on_triangle(p, mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]]);
    if (const double away = length(minus(p, on)); away < least) {
      least = away;
      nearest = on;
    }
  }
  return nearest;
}

double distance_to(const SharpEdge& edge, const Point& p) {
  double least = std::numeric_limits<double>::max();
  for (const auto& [a, b] : edge.pieces) least = std::min(least, length(minus(p, nearest_on_piece(p, a, b))));
  return least;
}

/// Direction in the face, away from the edge and at right angles to it.
Vector across_edge(const CellMesh& mesh, const SharpSide& side) {
  const int* n = mesh.face(side.face);
  const Point a = mesh.points[n[side.edge]], b = mesh.points[n[(side.edge + 1) % 3]],
              c = mesh.points[n[(side.edge + 2) % 3]];
  const Vector edge = unit(minus(b, a)), into = minus(c, a);
  return unit(along(into, edge, -dot(into, edge)));
}

/// A mesh edge of a weld, from one of its nodes to the other along the weld.
struct WeldStep {
  int from = 0, to = 0;
  std::array<SharpSide, 2> sides{};
};

/// Steps end to end, each chain from that end of it which comes first in x, y, z: the same for every mesh. A
/// ring begins at its first node.
std::vector<std::vector<WeldStep>> chains_of(const CellMesh& mesh, std::vector<WeldStep> steps) {
  const auto at = [&](int node) { return mesh.points[std::size_t(node)]; };
  std::map<int, int> n_steps;
  for (const auto& step : steps) {
    ++n_steps[step.from];
    ++n_steps[step.to];
  }
  std::vector<std::vector<WeldStep>> chains;
  while (!steps.empty()) {
    int begin = -1;
    bool is_end = false;  // whether `begin` is the end of a chain; such nodes come before any node of a ring
    for (const auto& step : steps)
      for (const int node : {step.from, step.to}) {
        const bool ends = n_steps[node] != 2;
        if (begin < 0 || (ends && !is_end) || (ends == is_end && at(node) < at(begin))) {
          begin = node;
          is_end = ends;
        }
      }
    chains.emplace_back();
    for (int node = begin;;) {
      const auto next = std::find_if(steps.begin(), steps.end(),
                                     [&](const auto& step) { return step.from == node || step.to == node; });
      if (next == steps.end()) break;
      WeldStep step = *next;
      steps.erase(next);
      if (step.to == node) std::swap(step.from, step.to);
      chains.back().push_back(step);
      node = step.to;
      if (n_steps[node] != 2) break;
    }
  }
  return chains;
}

/// A place of a weld's toe, with the faces on both sides.
struct ToePlace {
  Point at{};
  std::array<SharpSide, 2> sides{};
};

/// Places along a chain, as far apart as a plate is thick or closer, half of that from the ends.
std::vector<ToePlace> places_along(const CellMesh& mesh, const std::vector<WeldStep>& chain,
                                   double thickness_m) {
  const auto at = [&](int node) { return mesh.points[std::size_t(node)]; };
  double length_m = 0;
  for (const auto& step : chain) length_m += length(minus(at(step.to), at(step.from)));
  const int n = std::max(1, int(std::ceil(length_m / thickness_m - 1e-6)));
  std::vector<ToePlace> places;
  double passed_m = 0;
  for (const auto& step : chain) {
    const Vector along_step = minus(at(step.to), at(step.from));
    const double step_m = length(along_step);
    for (double next_m; int(places.size()) < n &&
                        (next_m = length_m * (double(places.size()) + 0.5) / n) <= passed_m + step_m;)
      places.push_back({along(at(step.from), along_step, (next_m - passed_m) / step_m), step.sides});
    passed_m += step_m;
  }
  return places;
}

}  // namespace

PartToes place_weld_toes(const CellMesh& mesh, const std::map<int, std::string>& names, const PartWeld& weld,
                         int number, std::vector<SharpEdge>& edges) {
  char place[100];
  std::snprintf(place, sizeof place, "(%.4g, %.4g, %.4g) mm", 1e3 * weld.at_m[0], 1e3 * weld.at_m[1],
                1e3 * weld.at_m[2]);
  if (mesh.kind != CellKind::tetrahedra)
    throw GeometryRefused(std::string("the weld at ") + place +
                          ": hot-spot stress is read on tetrahedra only; give the part as STEP");
  const double t = weld.thickness_m;
  const auto edge = std::min_element(edges.begin(), edges.end(), [&](const auto& one, const auto& other) {
    return distance_to(one, weld.at_m) < distance_to(other, weld.at_m);
  });
  if (edge == edges.end() || distance_to(*edge, weld.at_m) > t)
    throw GeometryRefused(std::string("the weld at ") + place +
                          ": no sharp inner edge is within a plate thickness of that point; give a point on "
                          "the edge");
  edge->distance_m = std::max(edge->distance_m, t);
  std::vector<WeldStep> steps;
  for (const auto& sides : sharp_sides(mesh)) {
    const int* n = mesh.face(sides[0].face);
    const int id = mesh.face_id[sides[0].face], other_id = mesh.face_id[sides[1].face];
    if (name_of_pair(names, id, other_id) != edge->name) continue;
    steps.push_back({n[sides[0].edge], n[(sides[0].edge + 1) % 3], sides});
    if (other_id < id) std::swap(steps.back().sides[0], steps.back().sides[1]);
  }
  PartToes toes;
  std::map<int, int> count;  // toes counted so far on each group
  for (const auto& chain : chains_of(mesh, std::move(steps)))
    for (const auto& toe : places_along(mesh, chain, t))
      for (const auto& side : toe.sides) {
        const int id = mesh.face_id[side.face];
        HotSpot spot{
            "weld " + std::to_string(number) + " toe " + std::to_string(++count[id]) + " on " + names.at(id),
            t,
            toe.at,
            {},
            {}};
        const Vector across = across_edge(mesh, side);
        bool is_read = true;
        for (const auto& [walls, point] :
             {std::pair(near_walls, &spot.near_m), std::pair(far_walls, &spot.far_m)}) {
          const Point wanted = along(toe.at, across, walls * t);
          *point = nearest_on_group(mesh, id, wanted);
          is_read = is_read && length(minus(*point, wanted)) <= off_face_walls * t;
        }
        if (is_read)
          toes.hot_spots.push_back(spot);
        else
          toes.covered.push_back(spot.name);
      }
  return toes;
}

}  // namespace meshes
