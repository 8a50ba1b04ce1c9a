#include "meshes/checks/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "meshes/values/constants.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

/// A boundary quad's middle and unit outward normal (of the plane through its edges' middles).
struct Facet {
  Point middle{}, normal{};
  int boundary_id = 0;
};

Facet facet_of(const HexMesh& mesh, const BoundaryQuad& quad) {
  Facet facet;
  facet.boundary_id = quad.boundary_id;
  for (const int node : quad.nodes)
    for (int d = 0; d < 3; ++d) facet.middle[d] += 0.25 * mesh.points[node][d];
  const Point a = minus(mesh.points[quad.nodes[2]], mesh.points[quad.nodes[0]]);
  const Point b = minus(mesh.points[quad.nodes[3]], mesh.points[quad.nodes[1]]);
  const Point n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(dot(n, n));
  for (int d = 0; d < 3; ++d) facet.normal[d] = n[d] / length;
  return facet;
}

bool is_reentrant(const Facet& a, const Facet& b, double largest_cosine) {
  return dot(a.normal, b.normal) < largest_cosine && dot(minus(b.middle, a.middle), a.normal) > 0;
}

/// Structural stress of a plate begins one thickness of that plate from a toe, but what is welded to it
/// disturbs it no farther than a few times its own.
double distance_on(const PlateSurface& plate, double smaller_m) {
  constexpr double most = 2;
  return std::min(plate.thickness_m, most * smaller_m);
}

bool is_on(const Point& p, const PlateSurface& surface) {
  constexpr double rounding = 1e-9;
  const double r_m = std::hypot(p[0] - surface.axis_x_m, p[1] - surface.axis_y_m);
  return surface.radius_m > 0 && std::abs(r_m - surface.radius_m) <= rounding * surface.radius_m;
}

/// Adds pieces along the cylinder that both ends are on: a chord's arrow, r (1 - cos(turn / 2 n)), is at most
/// r (turn / 2 n)^2 / 2.
void add_pieces(const Point& from, const Point& to, const PlateSurface& surface, SharpEdge& edge) {
  constexpr double off_arc = 5e-3;
  const auto angle = [&](const Point& p) {
    return std::atan2(p[1] - surface.axis_y_m, p[0] - surface.axis_x_m);
  };
  const double begin = angle(from), turn = std::remainder(angle(to) - begin, 2 * pi);
  const double share = 2 * off_arc * edge.distance_m / surface.radius_m;
  const int n = std::max(1, int(std::ceil(std::abs(turn) / 2 / std::sqrt(share))));
  const auto at = [&](int i) -> Point {
    if (i == 0 || i == n) return i == 0 ? from : to;
    const double x = double(i) / n;
    return {surface.axis_x_m + surface.radius_m * std::cos(begin + x * turn),
            surface.axis_y_m + surface.radius_m * std::sin(begin + x * turn),
            from[2] + x * (to[2] - from[2])};
  };
  for (int i = 0; i < n; ++i) edge.pieces.push_back({at(i), at(i + 1)});
}

}  // namespace

std::vector<SharpEdge> find_sharp_edges(const HexMesh& mesh, const std::map<int, PlateSurface>& surfaces,
                                        double smallest_turn_rad) {
  std::map<std::pair<int, int>, std::vector<Facet>> facets_at;  // by the edge's nodes
  for (const BoundaryQuad& quad : mesh.quads) {
    if (!surfaces.count(quad.boundary_id)) continue;
    const Facet facet = facet_of(mesh, quad);
    for (int i = 0; i < 4; ++i)
      facets_at[std::minmax({quad.nodes[i], quad.nodes[(i + 1) % 4]})].push_back(facet);
  }

  const double largest_cosine = std::cos(smallest_turn_rad);
  std::map<std::pair<int, int>, SharpEdge> edges;  // by the groups' ids
  for (const auto& [nodes, facets] : facets_at)
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (std::size_t j = i + 1; j < facets.size(); ++j) {
        if (!is_reentrant(facets[i], facets[j], largest_cosine)) continue;
        const std::pair<int, int> ids = std::minmax({facets[i].boundary_id, facets[j].boundary_id});
        const PlateSurface &low = surfaces.at(ids.first), &high = surfaces.at(ids.second);
        SharpEdge& edge = edges[ids];
        edge.name = high.name + "/" + low.name;
        edge.distance_m = std::min(low.thickness_m, high.thickness_m);
        edge.distance_on_m = {{ids.first, distance_on(low, edge.distance_m)},
                              {ids.second, distance_on(high, edge.distance_m)}};
        const Point &from = mesh.points[nodes.first], &to = mesh.points[nodes.second];
        const auto* round = is_on(from, low) && is_on(to, low)     ? &low
                            : is_on(from, high) && is_on(to, high) ? &high
                                                                   : nullptr;
        if (round != nullptr)
          add_pieces(from, to, *round, edge);
        else
          edge.pieces.push_back({from, to});
      }

  std::vector<SharpEdge> result;
  for (auto& entry : edges) result.push_back(std::move(entry.second));
  return result;
}

}  // namespace meshes
