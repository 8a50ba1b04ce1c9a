#include <algorithm>
#include <cmath>
#include <map>

#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/charts.h"
#include "fem/stress/cells/sections.h"

namespace fem {

namespace {

struct RingNode {
  std::int32_t node = 0;
  double z_m = 0, radius_m = 0;
  int boundary_id = 0;
};

bool is_flat(const Grid& grid, const std::vector<std::int32_t>& nodes) {
  double low = grid.position(nodes[0])[2], high = low, size = 0;
  for (const auto node : nodes) {
    low = std::min(low, grid.position(node)[2]);
    high = std::max(high, grid.position(node)[2]);
    for (int d = 0; d < 2; ++d)
      size = std::max(size, std::abs(grid.position(node)[d] - grid.position(nodes[0])[d]));
  }
  return high - low <= 1e-6 * size;
}

/// Nodes of concentric surfaces with their group; where groups meet, a fillet's wins, then the smaller id.
std::vector<RingNode> concentric_nodes(const Grid& grid, const Body& body) {
  std::map<int, bool> concentric;  // by volume
  for (const auto& chart : body.cylinders)
    concentric[chart.volume_id] = chart.shift_x_m == 0 && chart.shift_y_m == 0;
  std::map<std::int32_t, std::pair<bool, int>> group;  // not a fillet, id: the smallest wins
  for (const auto& face : grid.boundary) {
    const auto nodes = nodes_of_face(grid, face.cell, face.face);
    const bool fillet = is_fillet(body.tori, face.boundary_id);
    const auto volume = concentric.find(grid.volume_id[face.cell]);
    if (!fillet && (volume == concentric.end() || !volume->second || is_flat(grid, nodes))) continue;
    const std::pair<bool, int> candidate(!fillet, face.boundary_id);
    for (const auto node : nodes) {
      if (std::binary_search(grid.hanging.node.begin(), grid.hanging.node.end(), node)) continue;
      const auto known = group.emplace(node, candidate).first;
      known->second = std::min(known->second, candidate);
    }
  }
  std::vector<RingNode> result;
  for (const auto& [node, id] : group) {
    const double* x = grid.position(node);
    result.push_back({node, x[2], std::hypot(x[0], x[1]), id.second});
  }
  return result;
}

/// Sorts by key and calls handle(begin, end) for every run of nodes whose keys follow each other within the
/// tolerance.
template <typename Iterator, typename Key, typename Handle>
void for_each_run(Iterator begin, Iterator end, double tolerance, const Key& key, const Handle& handle) {
  std::stable_sort(begin, end, [&](const auto& a, const auto& b) { return key(a) < key(b); });
  while (begin != end) {
    auto last = begin;
    while (last + 1 != end && key(*(last + 1)) - key(*last) <= tolerance) ++last;
    handle(begin, last + 1);
    begin = last + 1;
  }
}

}  // namespace

void respond_on_rings(const Grid& grid, const Body& body, UnitResponses& responses) {
  const std::size_t n_loads = responses.channels.size();
  responses.rings.clear();
  responses.ring_shear_Pa.clear();
  auto nodes = concentric_nodes(grid, body);
  double size = 0;
  for (const auto& node : nodes) size = std::max(size, node.radius_m);
  const double tolerance = 1e-7 * size;  // rounding of coordinates, far below any cell

  using Iterator = std::vector<RingNode>::iterator;
  const auto add_ring = [&](Iterator begin, Iterator end) {
    std::vector<double> weights(std::size_t(end - begin), 1.0 / double(end - begin));
    if (grid.hanging.n() > 0) {
      std::vector<double> angles_rad;
      for (auto node = begin; node != end; ++node)
        angles_rad.push_back(std::atan2(grid.position(node->node)[1], grid.position(node->node)[0]));
      weights = weights_around(angles_rad);
      if (weights.empty()) return;
    }
    const auto least = std::min_element(
        begin, end, [](const auto& a, const auto& b) { return a.boundary_id < b.boundary_id; });
    responses.rings.push_back({begin->z_m, begin->radius_m, least->boundary_id});
    for (std::size_t k = 0; k < n_loads; ++k) {
      std::array<double, 2> mean{};
      for (auto node = begin; node != end; ++node) {
        if (!responses.has(std::size_t(node->node))) continue;
        const double* x = grid.position(node->node);
        const auto shear = rim_shear(x[0], x[1], responses.unit_stress_Pa(node->node) + 6 * k);
        for (int c = 0; c < 2; ++c) mean[c] += weights[std::size_t(node - begin)] * shear[c];
      }
      responses.ring_shear_Pa.push_back(mean);
    }
  };
  for_each_run(
      nodes.begin(), nodes.end(), tolerance, [](const RingNode& n) { return n.z_m; },
      [&](Iterator begin, Iterator end) {
        for_each_run(
            begin, end, tolerance, [](const RingNode& n) { return n.radius_m; }, add_ring);
      });
  if (!responses.ring_shear_Pa.empty())
    responses.sum_over_ranks(responses.ring_shear_Pa.front().data(), 2 * responses.ring_shear_Pa.size());
}

}  // namespace fem
