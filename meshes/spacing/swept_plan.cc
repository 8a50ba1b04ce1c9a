#include "meshes/spacing/swept_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace meshes {

namespace {

int nearest_station(const std::vector<double>& stations_m, double z_m) {
  const auto above = std::lower_bound(stations_m.begin(), stations_m.end(), z_m);
  if (above == stations_m.begin()) return 0;
  const auto i = static_cast<int>(above - stations_m.begin());
  if (above == stations_m.end()) return i - 1;
  return *above - z_m < z_m - *(above - 1) ? i : i - 1;
}

/// Numbers the nodes in the order of their first use.
class Nodes {
public:
  Nodes(const Plan& plan, const std::vector<double>& stations_m, HexMesh& mesh)
      : plan_(plan),
        stations_m_(stations_m),
        mesh_(mesh),
        numbers_(plan.points.size() * stations_m.size(), -1) {}

  int at(int point, int station) {
    int& number = numbers_[static_cast<std::size_t>(station) * plan_.points.size() + point];
    if (number < 0) {
      number = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back({plan_.points[point][0], plan_.points[point][1], stations_m_[station]});
    }
    return number;
  }

private:
  const Plan& plan_;
  const std::vector<double>& stations_m_;
  HexMesh& mesh_;
  std::vector<int> numbers_;
};

/// Faces seen once so far, in an order that depends on node numbers only.
class OpenFaces {
public:
  void add(const Hex& hex, const PlanQuad& quad, const Slab& slab) {
    const auto& n = hex.nodes;
    toggle({n[0], n[3], n[2], n[1]}, slab.low_id);
    toggle({n[4], n[5], n[6], n[7]}, slab.high_id);
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      toggle({n[i], n[j], n[j + 4], n[i + 4]}, quad.edge_ids[i] ? quad.edge_ids[i] : slab.side_id);
    }
  }
  void move_to(HexMesh& mesh) const {
    for (const auto& entry : faces_) mesh.quads.push_back(entry.second);
  }

private:
  void toggle(const std::array<int, 4>& nodes, int boundary_id) {
    std::array<int, 4> key = nodes;
    std::sort(key.begin(), key.end());
    const auto inserted = faces_.insert({key, BoundaryQuad{nodes, boundary_id}});
    if (!inserted.second) faces_.erase(inserted.first);
  }
  std::map<std::array<int, 4>, BoundaryQuad> faces_;
};

}  // namespace

HexMesh sweep(const Plan& plan, const std::vector<double>& stations_m) {
  HexMesh mesh;
  Nodes nodes(plan, stations_m, mesh);
  OpenFaces faces;
  for (const PlanBlock& block : plan.blocks)
    for (const Slab& slab : block.slabs) {
      const int begin = nearest_station(stations_m, slab.begin_m);
      const int end = nearest_station(stations_m, slab.end_m);
      assert(begin < end && std::abs(stations_m[end] - slab.end_m) < 1e-6 * (slab.end_m - slab.begin_m));
      for (int layer = begin; layer < end; ++layer)
        for (const PlanQuad& quad : block.quads) {
          Hex hex;
          hex.volume_id = slab.volume_id;
          for (int i = 0; i < 4; ++i) {
            hex.nodes[i] = nodes.at(quad.corners[i], layer);
            hex.nodes[i + 4] = nodes.at(quad.corners[i], layer + 1);
          }
          faces.add(hex, quad, slab);
          mesh.hexes.push_back(hex);
        }
    }
  faces.move_to(mesh);
  return mesh;
}

}  // namespace meshes
