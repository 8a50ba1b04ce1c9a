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

std::map<int, SweptVolume> swept_volumes(const Plan& plan, const std::vector<double>& stations_m) {
  std::map<int, SweptVolume> volumes;
  for (const PlanBlock& block : plan.blocks) {
    double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (const PlanQuad& quad : block.quads)
      for (std::size_t i = 0; i < 4; ++i) {  // Green's theorem along the edges
        const auto &a = plan.points[std::size_t(quad.corners[i])],
                   &b = plan.points[std::size_t(quad.corners[(i + 1) % 4])];
        const double twice = a[0] * b[1] - b[0] * a[1];
        area += twice / 2;
        x += twice * (a[0] + b[0]) / 6;
        y += twice * (a[1] + b[1]) / 6;
        xx += twice * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 12;
        yy += twice * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]) / 12;
        xy += twice * (a[0] * b[1] + 2 * a[0] * a[1] + 2 * b[0] * b[1] + b[0] * a[1]) / 24;
      }
    for (const Slab& slab : block.slabs) {
      SweptVolume& volume = volumes[slab.volume_id];
      const int n = nearest_station(stations_m, slab.end_m) - nearest_station(stations_m, slab.begin_m);
      const double p = slab.begin_m, q = slab.end_m;
      const double length = q - p, z = (q * q - p * p) / 2, zz = (q * q * q - p * p * p) / 3;
      volume.n_cells += block.quads.size() * std::size_t(n);
      volume.volume_m3 += area * length;
      const double first[3] = {x * length, y * length, area * z},
                   second[6] = {xx * length, yy * length, area * zz, xy * length, y * z, x * z};
      for (std::size_t i = 0; i < 3; ++i) volume.first_m4[i] += first[i];
      for (std::size_t i = 0; i < 6; ++i) volume.second_m5[i] += second[i];
    }
  }
  return volumes;
}

}  // namespace meshes
