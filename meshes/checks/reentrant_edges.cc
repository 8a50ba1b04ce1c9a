#include "meshes/checks/reentrant_edges.h"

#include <algorithm>
#include <cmath>

#include "meshes/values/vectors.h"

namespace meshes {

namespace {

constexpr double cosine_of_limit = 0.5;  // 60 degrees

Point corner(const CellMesh& mesh, std::size_t face, std::size_t i) {
  return mesh.points[mesh.face(face)[i % mesh.corners_per_face()]];
}

Point unit_normal(const CellMesh& mesh, std::size_t face) {
  Point n = cross(minus(corner(mesh, face, 1), corner(mesh, face, 0)),
                  minus(corner(mesh, face, mesh.corners_per_face() - 1), corner(mesh, face, 0)));
  const double length = std::sqrt(dot(n, n));
  for (double& x : n) x /= length;
  return n;
}

}  // namespace

std::vector<SharpEdge> reentrant_edges(const CellMesh& mesh, const std::map<int, std::string>& names,
                                       double distance_m) {
  struct Side {
    std::size_t face, edge;
  };
  std::map<std::pair<int, int>, Side> open;  // edges met once
  std::map<std::string, SharpEdge> found;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    for (std::size_t e = 0; e < mesh.corners_per_face(); ++e) {
      const int a = mesh.face(f)[e], b = mesh.face(f)[(e + 1) % mesh.corners_per_face()];
      const auto [other, is_new] = open.emplace(std::minmax(a, b), Side{f, e});
      if (is_new) continue;
      const Point mine = unit_normal(mesh, f), its = unit_normal(mesh, other->second.face);
      // Re-entrant: the other face rises above the plane of this one.
      const Point across = corner(mesh, other->second.face, other->second.edge + 2);
      if (dot(mine, its) >= cosine_of_limit || dot(minus(across, mesh.points[a]), mine) <= 0) continue;
      const auto pair = std::minmax(names.at(mesh.face_id[f]), names.at(mesh.face_id[other->second.face]));
      SharpEdge& edge = found[pair.first + "/" + pair.second];
      edge.name = pair.first + "/" + pair.second;
      edge.distance_m = distance_m;
      edge.pieces.push_back({mesh.points[a], mesh.points[b]});
    }
  std::vector<SharpEdge> edges;
  for (auto& [name, edge] : found) edges.push_back(std::move(edge));
  return edges;
}

double diagonal_m(const CellMesh& mesh) {
  Point low = mesh.points.front(), high = low;
  for (const auto& p : mesh.points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  const Point size = minus(high, low);
  return std::sqrt(dot(size, size));
}

}  // namespace meshes
