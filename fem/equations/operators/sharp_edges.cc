#include "fem/equations/operators/sharp_edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fem/base/values/constants.h"
#include "fem/mesh/grid/cell_geometry.h"

namespace fem {

namespace {

constexpr double cosine_of_sharp_edge = 0.5;  // 60 degrees between the normals
constexpr double kink_between_groups_rad = 25 * pi / 180;

Eigen::Vector3d point(const Grid& grid, std::int32_t node) {
  return Eigen::Vector3d(grid.position(node));
}

Eigen::Vector3d mean_of_corners(const Grid& grid, const std::int32_t* nodes, int n_corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < n_corners; ++i) sum += point(grid, nodes[i]);
  return sum / n_corners;
}

/// A face of the surface: its corners 0, 1, 2 and the middles of the edges 01, 12, 20.
struct SurfaceFace {
  std::int32_t cell = 0;
  int boundary_id = 0;
  std::array<std::int32_t, 6> node{};
  Eigen::Vector3d normal, middle;  ///< of the flat face
};

std::vector<SurfaceFace> surface_of(const Grid& grid, std::optional<int> no_surface) {
  std::vector<SurfaceFace> faces;
  for (const auto& boundary : grid.boundary) {
    if (no_surface && boundary.boundary_id == *no_surface) continue;
    const auto nodes = nodes_of_face(grid, boundary.cell, boundary.face);
    auto& face = faces.emplace_back();
    face.cell = boundary.cell;
    face.boundary_id = boundary.boundary_id;
    std::copy_n(nodes.begin(), 6, face.node.begin());
    const Eigen::Vector3d a = point(grid, nodes[0]);
    face.normal = (point(grid, nodes[1]) - a).cross(point(grid, nodes[2]) - a).normalized();
    face.middle = mean_of_corners(grid, nodes.data(), 3);
  }
  return faces;
}

/// Direction along the curved face away from the middle of its edge e, at right angles to the edge.
Eigen::Vector3d into_face(const Grid& grid, const SurfaceFace& face, int e, const Eigen::Vector3d& along) {
  const auto at = [&](int i) { return point(grid, face.node[std::size_t(i)]); };
  const Eigen::Vector3d into = -0.5 * (at(e) + at((e + 1) % 3)) - at((e + 2) % 3) - 2 * at(3 + e) +
                               2 * (at(3 + (e + 1) % 3) + at(3 + (e + 2) % 3));
  return into - along * along.dot(into);
}

/// By how much the surface turns towards its outside from a face, across its edge e, to another one.
double kink_rad(const Grid& grid, const SurfaceFace& face, int e, const SurfaceFace& other, int its_edge) {
  const Eigen::Vector3d along =
      (point(grid, face.node[std::size_t((e + 1) % 3)]) - point(grid, face.node[std::size_t(e)]))
          .normalized();
  const Eigen::Vector3d a = into_face(grid, face, e, along), b = into_face(grid, other, its_edge, along);
  return std::atan2(b.dot(along.cross(a)), -b.dot(a));
}

/// The faces of the surface around one node of a sharp edge, and which of them an edge through it joins.
struct Surroundings {
  int n_sharp = 0;  ///< edges
  std::vector<std::size_t> beside_sharp;
  std::vector<std::size_t> faces;
  std::vector<std::pair<std::size_t, std::size_t>> joined;  ///< across edges that are not sharp
};

std::map<std::int32_t, Surroundings> sharp_nodes(const Grid& grid, const std::vector<SurfaceFace>& faces) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::size_t, int>> open;  // edges met once
  std::map<std::int32_t, Surroundings> sharp;
  std::vector<std::pair<std::array<std::int32_t, 2>, std::pair<std::size_t, std::size_t>>> others;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int e = 0; e < 3; ++e) {
      const auto a = faces[f].node[e], b = faces[f].node[(e + 1) % 3];
      const auto [known, is_new] = open.try_emplace(std::minmax(a, b), f, e);
      if (is_new) continue;
      const auto [g, its_edge] = known->second;
      const Eigen::Vector3d across = point(grid, faces[g].node[(its_edge + 2) % 3]) - point(grid, a);
      const bool is_sharp =
          (faces[f].normal.dot(faces[g].normal) < cosine_of_sharp_edge && across.dot(faces[f].normal) > 0) ||
          (faces[f].boundary_id != faces[g].boundary_id &&
           kink_rad(grid, faces[f], e, faces[g], its_edge) > kink_between_groups_rad);
      if (!is_sharp) {
        others.push_back({{a, b}, {f, g}});
        continue;
      }
      for (const auto node : {a, b, faces[f].node[3 + e]}) {
        auto& at = sharp[node];
        ++at.n_sharp;
        at.beside_sharp.insert(at.beside_sharp.end(), {f, g});
      }
    }
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto node : faces[f].node)
      if (const auto found = sharp.find(node); found != sharp.end()) found->second.faces.push_back(f);
  for (const auto& [ends, both] : others)
    for (const auto node : ends)
      if (const auto found = sharp.find(node); found != sharp.end()) found->second.joined.push_back(both);
  return sharp;
}

/// Sides of the faces around a node, from 0: those between two sharp edges are one. Where a single edge ends,
/// its two faces are the sides, and the others have none of their own.
std::map<std::size_t, int> sides_of_faces(const Surroundings& at) {
  std::map<std::size_t, int> side;
  if (at.n_sharp == 1) {
    side[std::min(at.beside_sharp[0], at.beside_sharp[1])] = 0;
    side[std::max(at.beside_sharp[0], at.beside_sharp[1])] = 1;
    return side;
  }
  std::map<std::size_t, std::size_t> first;  // face of the same side
  for (const auto f : at.faces) first[f] = f;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const auto& [f, g] : at.joined) {
      const auto least = std::min(first.at(f), first.at(g));
      is_changed = is_changed || first[f] != least || first[g] != least;
      first[f] = first[g] = least;
    }
  }
  std::map<std::size_t, int> number;
  for (const auto& [f, its_first] : first)
    side[f] = number.try_emplace(its_first, int(number.size())).first->second;
  return side;
}

/// Side of a cell at the node: of its own face there, else of the face in whose direction it lies.
int side_of_cell(const Grid& grid, const std::vector<SurfaceFace>& faces,
                 const std::map<std::size_t, int>& sides, std::int32_t node, std::int32_t cell) {
  const Eigen::Vector3d at = point(grid, node),
                        towards = (mean_of_corners(grid, grid.nodes_of(cell), 4) - at).normalized();
  int nearest = 0;
  double most = -2;
  for (const auto& [f, side] : sides) {
    if (faces[f].cell == cell) return side;
    const double along = towards.dot((faces[f].middle - at).normalized());
    if (along > most) {
      most = along;
      nearest = side;
    }
  }
  return nearest;
}

}  // namespace

SplitGrid split_at_sharp_edges(const Grid& grid, const CellsOfNodes& cells, std::optional<int> no_surface) {
  SplitGrid split{grid, {}};
  if (!grid.shape().is_tetrahedron()) return split;
  const auto faces = surface_of(grid, no_surface);
  for (const auto& [node, at] : sharp_nodes(grid, faces)) {
    const auto sides = sides_of_faces(at);
    std::map<int, std::int32_t> node_of_side;
    for (auto k = cells.begin[node]; k < cells.begin[node + 1]; ++k) {
      const auto cell = cells.cell[k];
      const int side = side_of_cell(grid, faces, sides, node, cell);
      const bool is_first = node_of_side.empty();
      const auto [known, is_new] =
          node_of_side.try_emplace(side, is_first ? node : static_cast<std::int32_t>(split.grid.n_nodes));
      if (is_new && !is_first) {
        ++split.grid.n_nodes;
        split.copy.push_back(node);
        split.grid.xyz_m.insert(split.grid.xyz_m.end(), grid.position(node), grid.position(node) + 3);
      }
      auto* of_cell = split.grid.cell_nodes.data() + std::size_t(cell) * grid.nodes_per_cell();
      *std::find(of_cell, of_cell + grid.nodes_per_cell(), node) = known->second;
    }
  }
  return split;
}

}  // namespace fem
