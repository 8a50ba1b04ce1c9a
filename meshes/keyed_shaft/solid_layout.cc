#include "meshes/keyed_shaft/solid_layout.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "meshes/values/refusal.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

constexpr double widest = 0.6;        // largest width of a keyway, as a share of the diameter
constexpr double smallest_web = 0.1;  // least material below the floor, as a share of the diameter
constexpr double smallest_wall = 0.01;

void check_keyway(const Keyway& keyway, const SolidSegment& segment, double bore_radius_m, bool is_first,
                  bool is_last) {
  const std::string who = "keyway on " + keyway.segment + ": ";
  const auto refuse = [&](const std::string& what) { throw GeometryRefused(who + what); };
  const double diameter_m = 2 * segment.radius_m;
  for (const auto& [name, value] : {std::pair("width", keyway.width_m), std::pair("depth", keyway.depth_m),
                                    std::pair("length", keyway.length_m)})
    if (!std::isfinite(value) || !(value > 0))
      refuse(std::string(name) + " " + mm(value) + " must be positive");
  if (!std::isfinite(keyway.begin_m) || !std::isfinite(keyway.angle_rad))
    refuse("begin and angle must be numbers");
  if (keyway.width_m > widest * diameter_m)
    refuse("width " + mm(keyway.width_m) + " is more than " + std::to_string(int(100 * widest)) +
           " % of the diameter " + mm(diameter_m) + "; make it narrower");
  const double half_m = keyway.width_m / 2, floor_m = segment.radius_m - keyway.depth_m;
  const double edge_m = std::sqrt(segment.radius_m * segment.radius_m - half_m * half_m);
  if (floor_m >= edge_m)
    refuse("depth " + mm(keyway.depth_m) + " does not reach below the edges of its width " +
           mm(keyway.width_m) + ", which lie " + mm(segment.radius_m - edge_m) + " deep; make it deeper");
  // The bore is concentric; the floor's nearest point to it lies off the segment's axis by the eccentricity.
  const double web_m =
      bore_radius_m > 0 ? floor_m - bore_radius_m - std::hypot(segment.axis_x_m, segment.axis_y_m) : floor_m;
  if (web_m < smallest_web * diameter_m)
    refuse("depth " + mm(keyway.depth_m) + " leaves " + mm(web_m) + " below the floor" +
           (bore_radius_m > 0 ? " to the bore of " + mm(2 * bore_radius_m) : " to the axis") +
           "; it must leave " + mm(smallest_web * diameter_m) + ": make it shallower");
  const double tiny_m = 1e-6 * diameter_m, end_m = keyway.begin_m + keyway.length_m;
  const bool open_begin =
      is_first && !keyway.round_ends && std::abs(keyway.begin_m - segment.begin_m) < tiny_m;
  const bool open_end = is_last && !keyway.round_ends && std::abs(end_m - segment.end_m) < tiny_m;
  if ((keyway.begin_m < segment.bare_begin_m + tiny_m && !open_begin) ||
      (end_m > segment.bare_end_m - tiny_m && !open_end))
    refuse("from z = " + mm(keyway.begin_m) + " to " + mm(end_m) +
           " does not lie inside its segment, which is "
           "cylindrical from " +
           mm(segment.bare_begin_m) + " to " + mm(segment.bare_end_m) + "; make it shorter or move it");
  if (keyway.round_ends && keyway.length_m <= keyway.width_m * (1 + 1e-6))
    refuse("length " + mm(keyway.length_m) + " with round ends must be more than its width " +
           mm(keyway.width_m));
}

/// Whether some point of the cross-section of one keyway, a little enlarged, is in the other one.
bool cross(const Keyway& a, const Keyway& b, const SolidSegment& segment) {
  constexpr int n = 40;  // points across and along the depth; the enlargement covers what lies between them
  const double margin_m = 0.02 * segment.radius_m, floor_m = segment.radius_m - a.depth_m - margin_m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double across_m = (a.width_m + 2 * margin_m) * (double(i) / n - 0.5);
      const double height_m = floor_m + (segment.radius_m - floor_m) * j / n;
      const Point seen = in_keyway(b, segment, from_keyway(a, segment, {across_m, 0, height_m}));
      if (std::abs(seen[0]) < b.width_m / 2 + margin_m && seen[2] > segment.radius_m - b.depth_m - margin_m)
        return true;
    }
  return false;
}

void check_pair(const Keyway& a, const Keyway& b, const SolidSegment& segment) {
  const bool apart = a.begin_m > b.begin_m + b.length_m || b.begin_m > a.begin_m + a.length_m;
  if (apart || !cross(a, b, segment)) return;
  throw GeometryRefused("two keyways on " + a.segment + " meet, at angles of " + std::to_string(a.angle_rad) +
                        " and " + std::to_string(b.angle_rad) +
                        " rad: turn or move one, or make them shallower");
}

}  // namespace

SolidLayout lay_out_solid(const Shaft& shaft) {
  SolidLayout layout;
  layout.fillets_m = shaft.fillets_m;
  const auto n = shaft.segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    const ShaftSegment& from = shaft.segments[i];
    SolidSegment segment;
    segment.begin_m = i > 0 ? shaft.segments[i - 1].end_m : from.begin_m;
    segment.end_m = from.end_m;
    segment.radius_m = from.diameter_m / 2;
    if (from.eccentricity_m != 0) {
      segment.axis_x_m = from.eccentricity_m * std::cos(from.eccentricity_angle_rad);
      segment.axis_y_m = from.eccentricity_m * std::sin(from.eccentricity_angle_rad);
    }
    const auto own_fillet = [&](std::size_t neighbour, std::size_t shoulder) {
      return shaft.segments[neighbour].diameter_m > from.diameter_m ? shaft.fillets_m[shoulder] : 0.0;
    };
    const double fillet_begin_m = i > 0 ? own_fillet(i - 1, i - 1) : 0;
    const double fillet_end_m = i + 1 < n ? own_fillet(i + 1, i) : 0;
    const double rim_m = std::max(fillet_begin_m, fillet_end_m);
    segment.bare_begin_m = segment.begin_m + fillet_begin_m;
    segment.bare_end_m = segment.end_m - fillet_end_m;
    segment.zone_begin_m = from.is_port ? segment.begin_m + rim_m : segment.bare_begin_m;
    segment.zone_end_m = from.is_port ? segment.end_m - rim_m : segment.bare_end_m;
    layout.segments.push_back(segment);
    if (from.bore_m != shaft.segments.front().bore_m)
      throw GeometryRefused("shaft: the bore of " + from.name + ", " + mm(from.bore_m) +
                            ", differs from that of " + shaft.segments.front().name + ", " +
                            mm(shaft.segments.front().bore_m) +
                            "; with keyways the bore has one diameter from end to end");
    const double wall_m = segment.radius_m - std::hypot(segment.axis_x_m, segment.axis_y_m) - from.bore_m / 2;
    if (!(from.bore_m >= 0) || wall_m < smallest_wall * from.diameter_m)
      throw GeometryRefused("shaft: the bore of " + mm(from.bore_m) + " leaves a wall of " + mm(wall_m) +
                            " in " + from.name + "; make it smaller");
  }
  layout.bore_radius_m = shaft.segments.front().bore_m / 2;
  return layout;
}

Point in_keyway(const Keyway& keyway, const SolidSegment& segment, const Point& point) {
  const double c = std::cos(keyway.angle_rad), s = std::sin(keyway.angle_rad);
  const double x = point[0] - segment.axis_x_m, y = point[1] - segment.axis_y_m;
  return {c * y - s * x, point[2], c * x + s * y};
}

Point from_keyway(const Keyway& keyway, const SolidSegment& segment, const Point& local) {
  const double c = std::cos(keyway.angle_rad), s = std::sin(keyway.angle_rad);
  return {segment.axis_x_m + c * local[2] - s * local[0], segment.axis_y_m + s * local[2] + c * local[0],
          local[1]};
}

std::size_t segment_of(const Keyway& keyway, const Shaft& shaft) {
  std::string names;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    if (shaft.segments[i].name == keyway.segment) return i;
    names += (i > 0 ? ", " : "") + shaft.segments[i].name;
  }
  throw GeometryRefused("keyway on \"" + keyway.segment + "\": the shaft has no such segment; it has " +
                        names);
}

void check_keyways(const Shaft& shaft, const SolidLayout& layout, const std::vector<Keyway>& keyways) {
  for (std::size_t k = 0; k < keyways.size(); ++k) {
    const std::size_t i = segment_of(keyways[k], shaft);
    check_keyway(keyways[k], layout.segments[i], layout.bore_radius_m, i == 0,
                 i + 1 == layout.segments.size());
    for (std::size_t other = 0; other < k; ++other)
      if (keyways[other].segment == keyways[k].segment)
        check_pair(keyways[other], keyways[k], layout.segments[i]);
  }
}

}  // namespace meshes
