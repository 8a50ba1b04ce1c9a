#include "meshes/shaft/revolve.h"

namespace meshes {

namespace {

/// Eccentric shift of each meridian point. Neighbours of an eccentric segment stay inside its inner radius.
std::vector<std::array<double, 2>> shifts_of(const Meridian& meridian, const ShaftLayout& layout) {
  std::vector<std::array<double, 2>> shifts(meridian.points.size(), {0, 0});
  for (const MeridianQuad& quad : meridian.quads) {
    const SegmentLayout& segment = layout.segments[quad.segment];
    if (!segment.is_eccentric()) continue;
    for (const int i : quad.corners) {
      const double beyond_m = meridian.points[i].r_m - segment.inner_radius_m;
      if (beyond_m <= 0) continue;
      const double share = beyond_m / (segment.radius_m - segment.inner_radius_m);
      shifts[i] = {segment.shift_x_m * share, segment.shift_y_m * share};
    }
  }
  return shifts;
}

/// Nodes of one core: the disc at each station of its line. Those on the circle belong to the meridian's
/// point.
class CoreNodes {
public:
  CoreNodes(const Disc& disc, const Meridian& meridian, const CoreLine& core, HexMesh& mesh)
      : core_(core), n_sectors_(disc.n_sectors) {
    for (const int point : core.points) {
      first_inner_.push_back(static_cast<int>(mesh.points.size()));
      for (std::size_t i = n_sectors_; i < disc.points.size(); ++i)
        mesh.points.push_back({core.radius_m * disc.points[i][0], core.radius_m * disc.points[i][1],
                               meridian.points[point].z_m});
    }
  }

  int n_stations() const { return static_cast<int>(core_.points.size()); }
  int node(int station, int disc_point) const {
    return disc_point < n_sectors_ ? core_.points[station] * n_sectors_ + disc_point
                                   : first_inner_[station] + disc_point - n_sectors_;
  }

private:
  const CoreLine& core_;
  int n_sectors_;
  std::vector<int> first_inner_;
};

void add_core(const Disc& disc, const CoreNodes& nodes, const CoreLine& core, int core_id, HexMesh& mesh) {
  for (int s = 0; s + 1 < nodes.n_stations(); ++s)
    for (const auto& quad : disc.quads) {
      Hex hex;
      hex.volume_id = core_id;
      for (int i = 0; i < 4; ++i) {
        hex.nodes[i] = nodes.node(s, quad[i]);
        hex.nodes[i + 4] = nodes.node(s + 1, quad[i]);
      }
      mesh.hexes.push_back(hex);
    }
  const int last = nodes.n_stations() - 1;
  for (const auto& quad : disc.quads) {  // outward normals
    mesh.quads.push_back(
        {{nodes.node(0, quad[0]), nodes.node(0, quad[3]), nodes.node(0, quad[2]), nodes.node(0, quad[1])},
         core.begin_id});
    mesh.quads.push_back({{nodes.node(last, quad[0]), nodes.node(last, quad[1]), nodes.node(last, quad[2]),
                           nodes.node(last, quad[3])},
                          core.end_id});
  }
}

}  // namespace

HexMesh revolve(const Meridian& meridian, const ShaftLayout& layout, const SurfaceTable& surfaces,
                const Disc& disc) {
  const int n_sectors = disc.n_sectors;
  const std::vector<std::array<double, 2>> shifts = shifts_of(meridian, layout);
  HexMesh mesh;
  for (std::size_t i = 0; i < meridian.points.size(); ++i) {
    const MeridianPoint& point = meridian.points[i];
    for (int j = 0; j < n_sectors; ++j) {
      const double y_m = point.r_m * disc.points[j][1];
      // Nothing is added where nothing is shifted: that would turn -0 into 0, and the file with it.
      mesh.points.push_back({point.r_m * disc.points[j][0] + shifts[i][0],
                             shifts[i][1] == 0 ? y_m : y_m + shifts[i][1], point.z_m});
    }
  }
  for (const CoreLine& core : meridian.cores)
    add_core(disc, CoreNodes(disc, meridian, core, mesh), core, surfaces.core_id, mesh);

  const auto node = [&](int point, int j) { return point * n_sectors + j % n_sectors; };
  for (const MeridianQuad& quad : meridian.quads)
    for (int j = 0; j < n_sectors; ++j) {
      Hex hex;
      hex.volume_id = surfaces.ring_ids[quad.segment];
      for (int i = 0; i < 4; ++i) {  // (z, r, angle) is right-handed
        hex.nodes[i] = node(quad.corners[i], j);
        hex.nodes[i + 4] = node(quad.corners[i], j + 1);
      }
      mesh.hexes.push_back(hex);
    }
  for (const MeridianEdge& edge : meridian.edges)
    for (int j = 0; j < n_sectors; ++j)
      mesh.quads.push_back({{node(edge.ends[0], j), node(edge.ends[1], j), node(edge.ends[1], j + 1),
                             node(edge.ends[0], j + 1)},
                            edge.boundary_id});
  return mesh;
}

}  // namespace meshes
