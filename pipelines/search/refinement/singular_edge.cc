#include "pipelines/search/refinement/singular_edge.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "pipelines/base/common/constants.h"
#include "pipelines/search/refinement/peak_growth.h"

namespace pipelines {
namespace {

using Vector = Eigen::Vector3d;

constexpr double smallest_kink_rad = 15 * pi / 180;

Vector position(const fem::Nodes& nodes, std::int32_t node) {
  return Eigen::Map<const Vector>(&nodes.xyz_m[3 * std::size_t(node)]);
}

/// Side k of a face, from its corner k to the next one.
struct Side {
  std::int32_t begin = 0, middle = 0, end = 0;
  bool is_loaded = false;
  Vector into_face;  ///< along the face, away from the side's middle
};

Side side_of(const fem::Nodes& nodes, const fem::NodeList& face, std::size_t k) {
  const std::size_t n_sides = face.size() == 9 ? 4 : 3;
  const auto at = [&](std::size_t i) { return position(nodes, face[i]); };
  const std::size_t next = (k + 1) % n_sides;
  Side side{face[k], face[n_sides + k], face[next], false, {}};
  if (n_sides == 4) {  // the parabola through the middles of this side, the face and the side across
    side.into_face = -3 * at(4 + k) + 4 * at(8) - at(4 + (k + 2) % 4);
  } else {
    const std::size_t across = (k + 2) % 3;
    side.into_face =
        -0.5 * (at(k) + at(next)) - at(across) - 2 * at(3 + k) + 2 * (at(3 + next) + at(3 + across));
  }
  return side;
}

/// Whether the surface turns towards its outside by more than the smallest kink, seen across a side of two
/// faces. Faces have their corners counter-clockwise from outside.
bool is_concave(const fem::Nodes& nodes, const Side& one, const Side& other) {
  const Vector along = (position(nodes, one.end) - position(nodes, one.begin)).normalized();
  const auto across = [&](const Side& side) {
    return (side.into_face - along * along.dot(side.into_face)).normalized();
  };
  const Vector a = across(one), b = across(other), outward = along.cross(a);
  return std::atan2(b.dot(outward), -b.dot(a)) > smallest_kink_rad;
}

}  // namespace

std::vector<std::array<std::array<double, 3>, 2>> singular_edge_through(const fem::Nodes& nodes,
                                                                        std::size_t node, double reach_m,
                                                                        const std::set<int>& loaded) {
  if (nodes.nodes_per_face() != 9 && nodes.nodes_per_face() != 6) return {};
  const std::size_t n_sides = nodes.nodes_per_face() == 9 ? 4 : 3;
  std::map<std::int32_t, Side> first;  // by the middle, which two faces share
  std::vector<Side> singular;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (std::size_t k = 0; k < n_sides; ++k) {
      Side side = side_of(nodes, nodes.face(f), k);
      side.is_loaded = loaded.count(nodes.face_boundary_id[f]) > 0;
      const auto [found, is_new] = first.try_emplace(side.middle, side);
      if (is_new) continue;
      const auto& other = found->second;
      if (other.is_loaded != side.is_loaded || is_concave(nodes, other, side)) singular.push_back(side);
    }
  std::multimap<std::int32_t, const Side*> at;
  for (const auto& side : singular)
    for (const auto n : {side.begin, side.middle, side.end}) at.emplace(n, &side);

  std::set<const Side*> taken;
  std::vector<std::int32_t> open;
  double nearest = reach_m;
  for (const auto& entry : at) {
    const double distance = (position(nodes, entry.first) - position(nodes, std::int32_t(node))).norm();
    if (distance > nearest || (distance == nearest && !open.empty())) continue;
    nearest = distance;
    open = {entry.first};
  }
  std::vector<std::array<std::array<double, 3>, 2>> segments;
  while (!open.empty()) {
    const auto [begin, end] = at.equal_range(open.back());
    open.pop_back();
    for (auto i = begin; i != end; ++i) {
      const Side& side = *i->second;
      if (!taken.insert(&side).second) continue;
      const auto point = [&](std::int32_t n) {
        const Vector x = position(nodes, n);
        return std::array<double, 3>{x[0], x[1], x[2]};
      };
      segments.push_back({point(side.begin), point(side.middle)});
      segments.push_back({point(side.middle), point(side.end)});
      open.insert(open.end(), {side.begin, side.end});
    }
  }
  return segments;
}

std::optional<EdgeWithoutBound> edge_without_bound(const Judged& analysis) {
  const auto& p = analysis.peak.position_m;
  const auto& nodes = analysis.responses.nodes;
  const double distance_m = left_out_around_edges_m(nodes);
  std::set<int> loaded;
  for (const auto& port : analysis.mesh.ports) loaded.insert(port.boundary_id);
  auto edge = singular_edge_through(nodes, analysis.peak.node, distance_m, loaded);
  if (edge.empty()) return std::nullopt;
  return EdgeWithoutBound{
      {"stress grows without bound at " + analysis.peak.feature, distance_m, std::move(edge)},
      fmt::format("{}: the stress at {} grows with every refinement, like at a sharp corner: {:.2g} mm "
                  "around the edge at ({:.1f}, {:.1f}, {:.1f}) mm are left out of the peak",
                  analysis.scene.name, analysis.peak.feature, 1e3 * distance_m, 1e3 * p[0], 1e3 * p[1],
                  1e3 * p[2])};
}

}  // namespace pipelines
