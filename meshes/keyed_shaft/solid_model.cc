#include <gmsh.h>

#include <algorithm>
#include <cmath>

#include "meshes/keyed_shaft/solid_layout.h"

namespace meshes {

namespace {

namespace occ = gmsh::model::occ;
constexpr double to_mm = 1e3;

/// A closed line in the plane y = 0 (or any), drawn point by point in m.
class Outline {
public:
  explicit Outline(const Point& start) : first_(add(start)), last_(first_), at_(start) {}
  void line_to(const Point& p) {
    if (same(p)) return;
    const int next = add(p);
    curves_.push_back(occ::addLine(last_, next));
    advance(next, p);
  }
  void arc_to(const Point& p, const Point& centre) {
    const int next = add(p);
    curves_.push_back(occ::addCircleArc(last_, add(centre), next));
    advance(next, p);
  }
  /// The plane inside, after a straight line back to the start.
  int close() {
    curves_.push_back(occ::addLine(last_, first_));
    return occ::addPlaneSurface({occ::addWire(curves_)});
  }

private:
  static int add(const Point& p) { return occ::addPoint(to_mm * p[0], to_mm * p[1], to_mm * p[2]); }
  bool same(const Point& p) const {
    return std::abs(p[0] - at_[0]) + std::abs(p[1] - at_[1]) + std::abs(p[2] - at_[2]) < 1e-12;
  }
  void advance(int next, const Point& p) {
    last_ = next;
    at_ = p;
  }
  int first_, last_;
  Point at_;
  std::vector<int> curves_;
};

gmsh::vectorpair turned_round(int surface, double axis_x_m, double axis_y_m) {
  gmsh::vectorpair parts, volumes;
  occ::revolve({{2, surface}}, to_mm * axis_x_m, to_mm * axis_y_m, 0, 0, 0, 1, 2 * std::acos(-1.0), parts);
  for (const auto& part : parts)
    if (part.first == 3) volumes.push_back(part);
  return volumes;
}

/// Surface of segment i between its fillets, divided at the ends of its loaded zone.
void draw_cylinder(const SolidSegment& segment, double x_m, Outline& outline) {
  for (const double z : {segment.bare_begin_m, segment.zone_begin_m, segment.zone_end_m, segment.bare_end_m})
    outline.line_to({x_m + segment.radius_m, 0, z});
}

/// Concentric segments first to last (included), with the fillets that lie on them.
gmsh::vectorpair concentric_run(const SolidLayout& layout, std::size_t first, std::size_t last) {
  const auto& segments = layout.segments;
  const double inner = layout.bore_radius_m;
  Outline outline({inner, 0, segments[first].begin_m});
  for (std::size_t i = first; i <= last; ++i) {
    const SolidSegment& s = segments[i];
    if (const double f = s.bare_begin_m - s.begin_m; f > 0) {
      outline.line_to({s.radius_m + f, 0, s.begin_m});
      outline.arc_to({s.radius_m, 0, s.begin_m + f}, {s.radius_m + f, 0, s.begin_m + f});
    }
    draw_cylinder(s, 0, outline);
    if (const double f = s.end_m - s.bare_end_m; f > 0)
      outline.arc_to({s.radius_m + f, 0, s.end_m}, {s.radius_m + f, 0, s.end_m - f});
  }
  for (std::size_t i = last + 1; i-- > first;)
    if (inner > 0 || i == last) outline.line_to({inner, 0, segments[i].end_m});
  return turned_round(outline.close(), 0, 0);
}

gmsh::vectorpair eccentric_disc(const SolidLayout& layout, const SolidSegment& segment) {
  const double x = segment.axis_x_m, y = segment.axis_y_m;
  Outline outline({x, y, segment.begin_m});
  for (const double z : {segment.begin_m, segment.zone_begin_m, segment.zone_end_m, segment.end_m})
    outline.line_to({x + segment.radius_m, y, z});
  outline.line_to({x, y, segment.end_m});
  auto disc = turned_round(outline.close(), x, y);
  if (layout.bore_radius_m == 0) return disc;
  const int hole = occ::addCylinder(0, 0, to_mm * segment.begin_m, 0, 0,
                                    to_mm * (segment.end_m - segment.begin_m), to_mm * layout.bore_radius_m);
  gmsh::vectorpair result;
  std::vector<gmsh::vectorpair> map;
  occ::cut(disc, {{3, hole}}, result, map);
  return result;
}

/// What the cutter sweeps, from the floor to above the surface.
std::pair<int, int> cutter(const Keyway& keyway, const SolidSegment& segment) {
  const double half = keyway.width_m / 2, begin = keyway.begin_m, end = begin + keyway.length_m;
  const double floor = segment.radius_m - keyway.depth_m, height = 0.2 * segment.radius_m + keyway.depth_m;
  const auto at = [&](double across, double z) { return from_keyway(keyway, segment, {across, z, floor}); };
  const double round = keyway.round_ends ? half : 0;
  Outline outline(at(-half, begin + round));
  if (keyway.round_ends) {
    outline.arc_to(at(0, begin), at(0, begin + half));
    outline.arc_to(at(half, begin + half), at(0, begin + half));
  } else {
    outline.line_to(at(half, begin));
  }
  outline.line_to(at(half, end - round));
  if (keyway.round_ends) {
    outline.arc_to(at(0, end), at(0, end - half));
    outline.arc_to(at(-half, end - half), at(0, end - half));
  } else {
    outline.line_to(at(-half, end));
  }
  gmsh::vectorpair parts;
  occ::extrude({{2, outline.close()}}, to_mm * height * std::cos(keyway.angle_rad),
               to_mm * height * std::sin(keyway.angle_rad), 0, parts);
  for (const auto& part : parts)
    if (part.first == 3) return part;
  throw std::string("a keyway has no volume");
}

}  // namespace

void model_solid(const Shaft& shaft, const SolidLayout& layout, const std::vector<Keyway>& keyways) {
  const auto n = layout.segments.size();
  gmsh::vectorpair parts, body, tools, result;
  for (std::size_t i = 0; i < n;) {
    std::size_t last = i;
    if (!layout.segments[i].is_eccentric())
      while (last + 1 < n && !layout.segments[last + 1].is_eccentric()) ++last;
    const auto part = layout.segments[i].is_eccentric() ? eccentric_disc(layout, layout.segments[i])
                                                        : concentric_run(layout, i, last);
    parts.insert(parts.end(), part.begin(), part.end());
    i = last + 1;
  }
  std::vector<gmsh::vectorpair> map;
  body = parts;
  // The ends of loaded zones stay edges: nothing is unified.
  gmsh::option::setNumber("Geometry.OCCUnionUnify", 0);
  if (parts.size() > 1) occ::fuse({parts.front()}, {parts.begin() + 1, parts.end()}, body, map);
  for (const auto& keyway : keyways)
    tools.push_back(cutter(keyway, layout.segments[segment_of(keyway, shaft)]));
  if (!tools.empty()) occ::cut(body, tools, result, map);
  occ::synchronize();
  // Construction leaves points, lines and faces of its own behind.
  gmsh::vectorpair all, kept;
  gmsh::model::getEntities(all, 2);
  gmsh::model::getBoundary(tools.empty() ? body : result, kept, false, false, false);
  for (const auto& entity : all)
    if (std::find(kept.begin(), kept.end(), entity) == kept.end()) occ::remove({entity}, true);
  occ::synchronize();
}

}  // namespace meshes
