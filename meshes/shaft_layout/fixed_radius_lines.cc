#include "meshes/shaft_layout/fixed_radius_lines.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "meshes/values/constants.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

const double steepest_line = 0.8;  // radius over length

/// Radius of the bore step at which the segment is the narrow one with a face left below it; 0: none.
double step_radius(const ShaftLayout& layout, int junction, int segment) {
  if (junction < 0 || junction >= static_cast<int>(layout.junctions.size())) return 0;
  const Junction& at = layout.junctions[junction];
  const bool has_face = at.is_bore_step && at.narrow == segment &&
                        layout.segments[segment].base_radius_m < at.step_radius_m * (1 - tiny);
  return has_face ? at.step_radius_m : 0;
}

/// The wide bore beyond the segment, seen from one of its junctions.
double step_at_other_end(const ShaftLayout& layout, int junction, int segment) {
  return step_radius(layout, segment == junction ? junction - 1 : junction + 1, segment);
}

bool passes_below(const Junction& junction, double radius_m) {
  return radius_m <= junction.small_radius_m - junction.fillet_m;
}

/// Where a line that wants to lie at radius_m passes a junction: there, unless it would run through the fan
/// or hug a sharp corner.
double at_junction(const Junction& junction, int segment, double radius_m) {
  if (junction.kind == Junction::Kind::flush || junction.small == segment) return radius_m;
  const double corner_m = junction.small_radius_m;
  if (!junction.has_fan()) return std::abs(radius_m - corner_m) < 0.05 * corner_m ? corner_m : radius_m;
  const double top_m = junction.top_radius_m, floor_m = corner_m - junction.depth_m;
  if (passes_below(junction, radius_m) || radius_m >= top_m + 0.5 * junction.fillet_m) return radius_m;
  return radius_m - floor_m < top_m - radius_m ? floor_m : top_m;
}

[[noreturn]] void refuse_steep(const SegmentLayout& segment, double from_m, double to_m) {
  std::ostringstream text;
  text << "shaft: the segment from z = " << segment.begin_m * 1e3 << " to " << segment.end_m * 1e3
       << " mm, diameter " << 2e3 * segment.radius_m
       << " mm, is too short between its bore steps or shoulders: "
       << "a row of cells would have to lead from radius " << std::min(from_m, to_m) * 1e3 << " to "
       << std::max(from_m, to_m) * 1e3 << " mm within "
       << (segment.column_end_m - segment.column_begin_m) * 1e3
       << " mm; make the segment longer, the fillet smaller, or move the bore step away from the shoulder";
  throw GeometryRefused(text.str());
}

}  // namespace

double radius_below_fan(const ShaftLayout& layout, int junction) {
  const Junction& at = layout.junctions[junction];
  double radius_m = layout.segments[at.small].base_radius_m;
  for (const int segment : {at.small, at.big}) {
    const double line_m = step_at_other_end(layout, junction, segment);
    if (segment == at.small || passes_below(at, line_m)) radius_m = std::max(radius_m, line_m);
  }
  return radius_m;
}

void set_lines(ShaftLayout& layout) {
  const int n = static_cast<int>(layout.segments.size());
  for (int i = 0; i < n; ++i) {
    SegmentLayout& segment = layout.segments[i];
    if (segment.is_eccentric()) {
      segment.line_begin_m = segment.line_end_m = segment.inner_radius_m;
      continue;
    }
    const double begin_m = step_radius(layout, i - 1, i), end_m = step_radius(layout, i, i);
    if (begin_m == 0 && end_m == 0) continue;
    const auto face = [&](double own_m, double other_m, int junction) {
      if (own_m > 0) return own_m;
      return junction < 0 || junction >= n - 1 ? other_m
                                               : at_junction(layout.junctions[junction], i, other_m);
    };
    segment.line_begin_m = face(begin_m, end_m, i - 1);
    segment.line_end_m = face(end_m, begin_m, i);
    const double column_m = segment.column_end_m - segment.column_begin_m;
    if (std::abs(segment.line_end_m - segment.line_begin_m) > steepest_line * column_m)
      refuse_steep(segment, segment.line_begin_m, segment.line_end_m);
  }
}

}  // namespace meshes
