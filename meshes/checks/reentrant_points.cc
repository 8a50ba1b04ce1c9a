#include "meshes/checks/reentrant_points.h"

#include <algorithm>
#include <set>

#include "meshes/values/vectors.h"

namespace meshes {

namespace {

constexpr double least_rise = 0.342;  // cosine of 70 degrees

struct BoundaryVertex {
  std::vector<Point> tangents;  // unit tangents of the edges that leave it
  Point outside{};              // sum of the unit normals of its faces
  std::set<int> surfaces;
};

Point unit(Point v) {
  const double size = length(v);
  for (double& x : v) x /= size;
  return v;
}

/// Tangent at a of the edge from a to b, which is a parabola where it has a middle.
Point tangent(const CellMesh& mesh, int a, int b, int middle) {
  Point along = minus(mesh.points[std::size_t(b)], mesh.points[std::size_t(a)]);
  if (middle >= 0)
    for (std::size_t d = 0; d < 3; ++d)
      along[d] = 4 * mesh.points[std::size_t(middle)][d] - 3 * mesh.points[std::size_t(a)][d] -
                 mesh.points[std::size_t(b)][d];
  return unit(along);
}

std::map<int, BoundaryVertex> boundary_vertices(const CellMesh& mesh) {
  const std::size_t n = mesh.corners_per_face();
  const bool curved = mesh.nodes_per_face() > n;
  std::map<int, BoundaryVertex> vertices;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    for (std::size_t i = 0; i < n; ++i) {
      const int* nodes = mesh.face(f);
      const std::size_t before = (i + n - 1) % n;
      const Point first = tangent(mesh, nodes[i], nodes[(i + 1) % n], curved ? nodes[n + i] : -1),
                  last = tangent(mesh, nodes[i], nodes[before], curved ? nodes[n + before] : -1);
      BoundaryVertex& vertex = vertices[nodes[i]];
      vertex.tangents.push_back(first);  // each edge is the first one of one face
      vertex.surfaces.insert(mesh.face_id[f]);
      const Point normal = cross(first, last);
      if (const double size = length(normal); size > 0)
        for (std::size_t d = 0; d < 3; ++d) vertex.outside[d] += normal[d] / size;
    }
  return vertices;
}

bool is_within_one_surface(const SharpEdge& edge) {
  const std::size_t half = edge.name.size() / 2;
  return edge.name.size() % 2 == 1 && edge.name[half] == '/' &&
         edge.name.compare(0, half, edge.name, half + 1, half) == 0;
}

bool is_tip(const BoundaryVertex& vertex) {
  const double size = length(vertex.outside);
  return size > 0 && std::all_of(vertex.tangents.begin(), vertex.tangents.end(), [&](const Point& along) {
           return dot(along, vertex.outside) > least_rise * size;
         });
}

}  // namespace

void add_reentrant_points(const CellMesh& mesh, const std::map<int, std::string>& names, double distance_m,
                          std::vector<SharpEdge>& edges) {
  std::set<Point> on_edges, at_tips;
  for (const auto& edge : edges)
    if (!is_within_one_surface(edge))
      for (const auto& piece : edge.pieces) on_edges.insert(piece.begin(), piece.end());
  std::vector<SharpEdge> tips;
  for (const auto& [node, vertex] : boundary_vertices(mesh)) {
    const Point& at = mesh.points[std::size_t(node)];
    if (!is_tip(vertex) || on_edges.count(at) > 0) continue;
    std::string name;
    for (const int id : vertex.surfaces) name += (name.empty() ? "tip of " : "/") + names.at(id);
    tips.push_back({name, distance_m, {{at, at}}});
    at_tips.insert(at);
  }
  for (auto& edge : edges)
    if (is_within_one_surface(edge))
      edge.pieces.erase(std::remove_if(edge.pieces.begin(), edge.pieces.end(),
                                       [&](const auto& piece) {
                                         return at_tips.count(piece[0]) + at_tips.count(piece[1]) > 0;
                                       }),
                        edge.pieces.end());
  edges.erase(
      std::remove_if(edges.begin(), edges.end(), [](const SharpEdge& edge) { return edge.pieces.empty(); }),
      edges.end());
  edges.insert(edges.end(), tips.begin(), tips.end());
}

}  // namespace meshes
