#include "meshes/checks/reentrant_edges.h"

#include <algorithm>
#include <cmath>

#include "meshes/values/constants.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

constexpr double cosine_of_limit = 0.5;  // 60 degrees
/// At the seam of two surfaces straight cells of a fillet, eight around a circle, turn by 22.5 degrees.
constexpr double limit_between_surfaces_rad = 25 * pi / 180;

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

/// Direction along a face, away from the middle of one of its edges, and at right angles to the edge; of
/// quadratic triangles along their curved surface.
Point into_face(const CellMesh& mesh, const SharpSide& side, const Point& along) {
  const Point a = corner(mesh, side.face, side.edge), b = corner(mesh, side.face, side.edge + 1),
              across = corner(mesh, side.face, side.edge + 2);
  Point into{};
  const bool is_curved = mesh.corners_per_face() == 3 && mesh.nodes_per_face() == 6;
  const auto middle = [&](std::size_t e) {
    return mesh.points[std::size_t(mesh.face(side.face)[3 + e % 3])];
  };
  for (std::size_t d = 0; d < 3; ++d)
    into[d] = is_curved ? -0.5 * (a[d] + b[d]) - across[d] - 2 * middle(side.edge)[d] +
                              2 * (middle(side.edge + 1)[d] + middle(side.edge + 2)[d])
                        : across[d] - 0.5 * (a[d] + b[d]);
  const double part = dot(into, along);
  for (std::size_t d = 0; d < 3; ++d) into[d] -= part * along[d];
  return into;
}

/// By how much the surface turns towards its outside across an edge of two faces.
double kink_rad(const CellMesh& mesh, const SharpSide& one, const SharpSide& other) {
  Point along = minus(corner(mesh, one.face, one.edge + 1), corner(mesh, one.face, one.edge));
  const double size = length(along);
  for (double& x : along) x /= size;
  const Point a = into_face(mesh, one, along), b = into_face(mesh, other, along);
  return std::atan2(dot(b, cross(along, a)), -dot(b, a));
}

/// Pieces along the parabola through the ends of a curved edge and its middle, which they leave by less than
/// a thousandth of the distance.
void add_arc(const Point& from, const Point& middle, const Point& to, SharpEdge& edge) {
  constexpr double off_arc = 1e-3;
  constexpr int most = 64;
  Point arrow{};
  for (int d = 0; d < 3; ++d) arrow[d] = middle[d] - 0.5 * (from[d] + to[d]);
  const double share = std::sqrt(dot(arrow, arrow)) / (off_arc * edge.distance_m);
  const int n = share < 1 ? 1 : int(std::min(double(most), std::ceil(std::sqrt(share))));
  const auto at = [&](int i) {
    const double x = double(i) / n;
    Point p{};
    for (int d = 0; d < 3; ++d) p[d] = from[d] + x * (to[d] - from[d]) + 4 * x * (1 - x) * arrow[d];
    return p;
  };
  for (int i = 0; i < n; ++i) edge.pieces.push_back({i == 0 ? from : at(i), i + 1 == n ? to : at(i + 1)});
}

}  // namespace

std::vector<std::array<SharpSide, 2>> sharp_sides(const CellMesh& mesh) {
  std::map<std::pair<int, int>, SharpSide> open;  // edges met once
  std::vector<std::array<SharpSide, 2>> found;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    for (std::size_t e = 0; e < mesh.corners_per_face(); ++e) {
      const int a = mesh.face(f)[e], b = mesh.face(f)[(e + 1) % mesh.corners_per_face()];
      const auto [other, is_new] = open.emplace(std::minmax(a, b), SharpSide{f, e});
      if (is_new) continue;
      const Point mine = unit_normal(mesh, f), its = unit_normal(mesh, other->second.face);
      // Re-entrant: the other face rises above the plane of this one.
      const Point across = corner(mesh, other->second.face, other->second.edge + 2);
      const bool is_sharp = dot(mine, its) < cosine_of_limit && dot(minus(across, mesh.points[a]), mine) > 0,
                 is_seam = mesh.face_id[f] != mesh.face_id[other->second.face];
      if (is_sharp || (is_seam && kink_rad(mesh, {f, e}, other->second) > limit_between_surfaces_rad))
        found.push_back({SharpSide{f, e}, other->second});
    }
  return found;
}

std::string name_of_pair(const std::map<int, std::string>& names, int id, int other_id) {
  const auto pair = std::minmax(names.at(id), names.at(other_id));
  return pair.first + "/" + pair.second;
}

std::vector<SharpEdge> reentrant_edges(const CellMesh& mesh, const std::map<int, std::string>& names,
                                       double distance_m) {
  std::map<std::string, SharpEdge> found;
  for (const auto& [side, other] : sharp_sides(mesh)) {
    const auto name = name_of_pair(names, mesh.face_id[side.face], mesh.face_id[other.face]);
    SharpEdge& edge = found[name];
    edge.name = name;
    edge.distance_m = distance_m;
    const Point a = corner(mesh, side.face, side.edge), b = corner(mesh, side.face, side.edge + 1);
    const std::size_t between =
        mesh.corners_per_face() + side.edge;  // on the middle of the edge, where there is one
    if (between < mesh.nodes_per_face())
      add_arc(a, mesh.points[mesh.face(side.face)[between]], b, edge);
    else
      edge.pieces.push_back({a, b});
  }
  std::vector<SharpEdge> edges;
  for (auto& [name, edge] : found) edges.push_back(std::move(edge));
  return edges;
}

BodySize size_within(const std::vector<std::array<Point, 3>>& surface) {
  BodySize size;
  if (surface.empty()) return size;
  const Point origin = surface.front()[0];
  Point first{};  // m4, about the origin, as the second moment is first
  for (const auto& corners : surface) {
    const Point a = minus(corners[0], origin), b = minus(corners[1], origin), c = minus(corners[2], origin);
    const Point normal = cross(minus(b, a), minus(c, a));
    size.area_m2 += std::sqrt(dot(normal, normal)) / 2;
    // Signed volume of the tetrahedron from the origin to this face.
    const double volume_m3 = dot(a, normal) / 6;
    const Point sum = {a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
    size.volume_m3 += volume_m3;
    size.second_moment_m5 += volume_m3 / 20 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
    for (int d = 0; d < 3; ++d) first[d] += volume_m3 / 4 * sum[d];
  }
  size.second_moment_m5 -= dot(first, first) / size.volume_m3;
  return size;
}

double usual_exclusion_m(const BodySize& size) {
  constexpr double share_of_diagonal = 0.01;
  const double diagonal_m = std::sqrt(12 * size.second_moment_m5 / size.volume_m3);
  return std::min(share_of_diagonal * diagonal_m, size.volume_m3 / size.area_m2);
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
