#include "meshes/shaft_layout/shaft_surfaces.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace meshes {

namespace {

// Share of the distance left out by which chords leave the circle; nodes at that distance are kept to 2e-3.
constexpr double off_circle = 1e-3;

/// Adds features with rising ids.
class FeatureList {
public:
  explicit FeatureList(SurfaceTable& table, int next_id) : table_(table), next_id_(next_id) {}

  int add(const std::string& name, Feature::Kind kind, double begin_m, double end_m) {
    table_.features.push_back({name, kind, next_id_, begin_m, end_m});
    return next_id_++;
  }

private:
  SurfaceTable& table_;
  int next_id_;
};

std::vector<CylinderPiece> name_cylinder(const std::string& name, const SegmentLayout& segment,
                                         FeatureList& features) {
  using Kind = Feature::Kind;
  const double begin_m = segment.begin_m + segment.own_fillet_begin_m;
  const double end_m = segment.end_m - segment.own_fillet_end_m;
  if (!segment.is_port) return {{begin_m, end_m, features.add(name, Kind::surface, begin_m, end_m)}};

  const double from_m = segment.zone_begin_m, to_m = segment.zone_end_m;
  std::vector<CylinderPiece> pieces;
  if (from_m > begin_m)
    pieces.push_back({begin_m, from_m, features.add(name + " rim 1", Kind::surface, begin_m, from_m)});
  pieces.push_back({from_m, to_m, features.add(name, Kind::seat, from_m, to_m)});
  if (to_m < end_m)
    pieces.push_back({to_m, end_m, features.add(name + " rim 2", Kind::surface, to_m, end_m)});
  return pieces;
}

JunctionSurfaces name_junction(const std::string& pair, const Junction& junction, FeatureList& features) {
  JunctionSurfaces ids;
  if (junction.is_bore_step)
    ids.step_id = features.add("shoulder bore " + pair, Feature::Kind::shoulder, junction.z_m, junction.z_m);
  if (junction.kind == Junction::Kind::flush) return ids;
  if (junction.kind == Junction::Kind::fillet) {
    const double foot_m = junction.z_m - junction.direction * junction.fillet_m;
    ids.fillet_id = features.add("fillet " + pair, Feature::Kind::fillet, std::min(foot_m, junction.z_m),
                                 std::max(foot_m, junction.z_m));
  }
  if (junction.has_shoulder_face)
    ids.shoulder_id = features.add("shoulder " + pair, Feature::Kind::shoulder, junction.z_m, junction.z_m);
  return ids;
}

/// Range in z of the inside of a segment.
struct BoreRange {
  double begin_m = 0, end_m = 0;
};

BoreRange bore_range(const ShaftLayout& layout, int segment) {
  const auto n = static_cast<int>(layout.segments.size());
  return {segment > 0 ? layout.junctions[segment - 1].bore_border_m : layout.segments.front().begin_m,
          segment + 1 < n ? layout.junctions[segment].bore_border_m : layout.segments.back().end_m};
}

}  // namespace

int SurfaceTable::cylinder_at(int segment, double z_m) const {
  const std::vector<CylinderPiece>& pieces = cylinders[segment];
  for (const CylinderPiece& piece : pieces)
    if (z_m < piece.end_m) return piece.boundary_id;
  return pieces.back().boundary_id;
}

SurfaceTable name_surfaces(const Shaft& shaft, const ShaftLayout& layout) {
  const auto n = static_cast<int>(shaft.segments.size());
  SurfaceTable table;
  for (int i = 0; i < n; ++i) table.ring_ids.push_back(table.core_id + 1 + i);
  FeatureList features(table, table.core_id + 1 + n);
  const double begin_m = shaft.segments.front().begin_m, end_m = shaft.segments.back().end_m;
  table.end_1_id = features.add("end_1", Feature::Kind::end_face, begin_m, begin_m);
  for (int i = 0; i < n; ++i) {
    table.cylinders.push_back(name_cylinder(shaft.segments[i].name, layout.segments[i], features));
    table.bore_ids.push_back(0);
    if (layout.segments[i].is_bored()) {
      const BoreRange range = bore_range(layout, i);
      table.bore_ids.back() =
          features.add("bore " + shaft.segments[i].name, Feature::Kind::bore, range.begin_m, range.end_m);
    }
    if (i + 1 < n)
      table.junctions.push_back(name_junction(shaft.segments[i].name + "/" + shaft.segments[i + 1].name,
                                              layout.junctions[i], features));
  }
  table.end_2_id = features.add("end_2", Feature::Kind::end_face, end_m, end_m);
  return table;
}

std::vector<Port> ports_of(const Shaft& shaft, const ShaftLayout& layout, const SurfaceTable& surfaces) {
  const SegmentLayout& first = layout.segments.front();
  const SegmentLayout& last = layout.segments.back();
  std::vector<Port> ports;
  ports.push_back({"end_1", Port::Kind::face, surfaces.end_1_id, first.begin_m, first.begin_m, first.radius_m,
                   first.shift_x_m, first.shift_y_m});
  for (std::size_t i = 0; i < layout.segments.size(); ++i) {
    const SegmentLayout& segment = layout.segments[i];
    if (segment.is_port) {
      const double middle_m = 0.5 * (segment.zone_begin_m + segment.zone_end_m);
      const int id = surfaces.cylinder_at(static_cast<int>(i), middle_m);
      ports.push_back({shaft.segments[i].name, Port::Kind::seat, id, segment.zone_begin_m, segment.zone_end_m,
                       segment.radius_m, segment.shift_x_m, segment.shift_y_m});
    }
    if (!shaft.segments[i].bore_port.empty()) {
      const BoreRange range = bore_range(layout, static_cast<int>(i));
      ports.push_back({shaft.segments[i].bore_port, Port::Kind::bore, surfaces.bore_ids[i], range.begin_m,
                       range.end_m, segment.bore_radius_m, 0, 0});
    }
  }
  ports.push_back({"end_2", Port::Kind::face, surfaces.end_2_id, last.end_m, last.end_m, last.radius_m,
                   last.shift_x_m, last.shift_y_m});
  return ports;
}

std::vector<SharpEdge> sharp_edges_of(const Shaft& shaft, const ShaftLayout& layout) {
  const auto circle = [&](const std::string& name, double z_m, double radius_m, double distance_m) {
    SharpEdge edge{name, distance_m, {}};
    // The arrow of a chord, r (1 - cos(pi / n)), is at most r (pi / n)^2 / 2.
    const double pi = std::acos(-1.0), share = off_circle * distance_m / radius_m;
    const int n = 4 * std::max(4, int(std::ceil(pi / std::sqrt(2 * share) / 4)));
    const auto at = [&](int j) -> std::array<double, 3> {
      const double angle = 2 * pi * (j % n) / n;
      return {radius_m * std::cos(angle), radius_m * std::sin(angle), z_m};
    };
    for (int j = 0; j < n; ++j) edge.pieces.push_back({at(j), at(j + 1)});
    return edge;
  };
  std::vector<SharpEdge> edges;
  for (std::size_t i = 0; i < layout.junctions.size(); ++i) {
    const Junction& junction = layout.junctions[i];
    const std::string pair = shaft.segments[i].name + "/" + shaft.segments[i + 1].name;
    if (junction.kind == Junction::Kind::sharp)
      edges.push_back(circle(pair, junction.z_m, junction.small_radius_m,
                             sharp_shoulder_distance_m(2 * junction.small_radius_m)));
    if (junction.is_bore_step)
      edges.push_back(circle("bore " + pair, junction.z_m, junction.step_radius_m,
                             layout.segments[junction.wide].radius_m - junction.step_radius_m));
  }
  return edges;
}

std::vector<CylinderChart> cylinders_of(const ShaftLayout& layout, const SurfaceTable& surfaces) {
  std::vector<CylinderChart> charts;
  for (std::size_t i = 0; i < layout.segments.size(); ++i) {
    const SegmentLayout& segment = layout.segments[i];
    charts.push_back({surfaces.ring_ids[i], segment.shift_x_m, segment.shift_y_m, segment.inner_radius_m,
                      segment.radius_m, 0, 0});
  }
  return charts;
}

std::vector<TorusChart> tori_of(const ShaftLayout& layout, const SurfaceTable& surfaces) {
  std::vector<TorusChart> charts;
  for (std::size_t i = 0; i < layout.junctions.size(); ++i) {
    const Junction& junction = layout.junctions[i];
    if (junction.kind != Junction::Kind::fillet) continue;
    charts.push_back({surfaces.junctions[i].fillet_id, junction.z_m - junction.direction * junction.fillet_m,
                      junction.small_radius_m + junction.fillet_m, junction.fillet_m});
  }
  return charts;
}

}  // namespace meshes
