#include "meshes/shaft_layout/shaft_layout.h"

#include <algorithm>
#include <cmath>

#include "meshes/shaft_layout/fixed_radius_lines.h"
#include "meshes/shaft_layout/radial_rows.h"
#include "meshes/spacing/grading.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

// Radius of the core, as a share of the smallest radius of the solid segments side by side.
const double core_share = 0.6;
const double core_share_limit = 0.7;  // up to this the core is as wide as the bore it closes
const double fan_depth = 3;           // in fillets, where there is room
const double fan_ratio = 1.6;         // growth of the cells from the arc into the fan
const double fan_ratio_before = 3;    // growth of cells that are cut up later

/// Cell boundaries of the fan from the arc outwards; a boundary at `must` (a fraction, 0: none) is forced.
std::vector<double> fan_fractions(double first, double must, double ratio) {
  const int n = geometric_count(1, first, ratio);
  if (must <= 0 || must >= 1) return geometric_fractions(n, first);
  const int n_near = geometric_count(must, first, ratio);
  const int n_far = std::max(1, n - n_near);
  std::vector<double> fractions;
  for (const double x : geometric_fractions(n_near, first / must)) fractions.push_back(must * x);
  const double last = must - fractions[n_near - 1];
  const auto far = geometric_fractions(n_far, last / (1 - must));
  for (int i = 1; i <= n_far; ++i) fractions.push_back(must + (1 - must) * far[i]);
  fractions.back() = 1;
  return fractions;
}

std::vector<SegmentLayout> segments_of(const Shaft& shaft) {
  std::vector<SegmentLayout> segments;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const ShaftSegment& from = shaft.segments[i];
    SegmentLayout segment;
    segment.begin_m = i > 0 ? shaft.segments[i - 1].end_m : from.begin_m;  // one number for the common plane
    segment.end_m = from.end_m;
    segment.radius_m = 0.5 * from.diameter_m;
    segment.bore_radius_m = 0.5 * from.bore_m;
    segment.shift_x_m = from.eccentricity_m * std::cos(from.eccentricity_angle_rad);
    segment.shift_y_m = from.eccentricity_m * std::sin(from.eccentricity_angle_rad);
    segment.is_port = from.is_port;
    if (i > 0 && shaft.segments[i - 1].diameter_m > from.diameter_m)
      segment.own_fillet_begin_m = shaft.fillets_m[i - 1];
    if (i + 1 < shaft.segments.size() && shaft.segments[i + 1].diameter_m > from.diameter_m)
      segment.own_fillet_end_m = shaft.fillets_m[i];
    const double rim_m = std::max(segment.own_fillet_begin_m, segment.own_fillet_end_m);
    segment.zone_begin_m = segment.begin_m + (segment.is_port ? rim_m : segment.own_fillet_begin_m);
    segment.zone_end_m = segment.end_m - (segment.is_port ? rim_m : segment.own_fillet_end_m);
    segments.push_back(segment);
  }
  return segments;
}

/// One core for solid segments side by side; it closes the narrowest bore beside them if it can.
void set_base_radii(std::vector<SegmentLayout>& segments) {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    segments[i].base_radius_m = segments[i].bore_radius_m;
    if (segments[i].is_bored()) continue;
    std::size_t end = i;
    double smallest_m = segments[i].radius_m;
    for (; end < segments.size() && !segments[end].is_bored(); ++end)
      smallest_m = std::min(smallest_m, segments[end].radius_m);
    double core_m = core_share * smallest_m;
    double bore_m = core_share_limit * smallest_m;
    bool closes = false;
    for (const SegmentLayout* side :
         {i > 0 ? &segments[i - 1] : nullptr, end < segments.size() ? &segments[end] : nullptr})
      if (side && side->bore_radius_m <= bore_m) {
        bore_m = side->bore_radius_m;
        closes = true;
      }
    if (closes) core_m = bore_m;
    for (std::size_t k = i; k < end; ++k) segments[k].base_radius_m = core_m;
    i = end - 1;
  }
}

/// Depth of the fan: three fillets where the small segment's ring (above a line that runs below the fan) and
/// the big segment's length leave room; moved onto the big segment's loaded zone where that begins close by.
double depth_of(const Junction& junction, const SegmentLayout& big, double base_radius_m,
                double zone_offset_m) {
  const double depth_m =
      std::min({fan_depth * junction.fillet_m, 0.5 * (junction.small_radius_m - base_radius_m),
                0.3 * (big.end_m - big.begin_m)});
  const bool close_by = zone_offset_m >= 0.6 * depth_m && zone_offset_m <= 1.3 * depth_m;
  return close_by ? zone_offset_m : depth_m;
}

double zone_offset_of(const Junction& junction, const SegmentLayout& big) {
  if (!big.is_port) return 0;
  return junction.direction > 0 ? big.zone_begin_m - big.begin_m : big.end_m - big.zone_end_m;
}

/// Cells on both halves of the fan's floor, so that the bores of both segments can meet in the plane.
int floor_cells_before_plane(const Junction& junction) {
  const int n = junction.n_half_arc;
  if (n < 2) return 0;
  const double share = junction.fillet_m / (junction.fillet_m + junction.depth_m);
  return std::clamp(static_cast<int>(std::lround(n * share)), 1, n - 1);
}

void set_fan(Junction& junction, const ShaftLayout& layout, double base_m, double ratio) {
  const SegmentLayout& big = layout.segments[junction.big];
  const double zone_offset_m = zone_offset_of(junction, big);
  junction.depth_m = depth_of(junction, big, base_m, zone_offset_m);
  junction.depth_fractions =
      fan_fractions(junction.first_cell_m / junction.depth_m, zone_offset_m / junction.depth_m, ratio);
}

void set_bore_border(Junction& junction, const ShaftLayout& layout) {
  junction.bore_border_m = junction.z_m;
  if (!junction.has_fan() || !layout.segments[junction.small].is_bored()) return;
  junction.n_floor_before_plane = floor_cells_before_plane(junction);
  if (junction.n_floor_before_plane == 0)  // one cell below the whole fan: the nearer end of it
    junction.bore_border_m +=
        junction.direction * (junction.fillet_m < junction.depth_m ? -junction.fillet_m : junction.depth_m);
}

Junction junction_of(const ShaftLayout& layout, const Shaft& shaft, int left, int n_half_arc) {
  const SegmentLayout& a = layout.segments[left];
  const SegmentLayout& b = layout.segments[left + 1];
  Junction junction;
  junction.direction = b.radius_m >= a.radius_m ? 1 : -1;
  junction.small = junction.direction > 0 ? left : left + 1;
  junction.big = junction.direction > 0 ? left + 1 : left;
  const SegmentLayout& big = layout.segments[junction.big];
  junction.z_m = a.end_m;
  junction.small_radius_m = layout.segments[junction.small].radius_m;
  junction.top_radius_m = junction.small_radius_m;
  junction.n_half_arc = n_half_arc;
  junction.is_bore_step = a.bore_radius_m != b.bore_radius_m;
  if (junction.is_bore_step) {
    junction.narrow = a.bore_radius_m < b.bore_radius_m ? left : left + 1;
    junction.wide = 2 * left + 1 - junction.narrow;
    junction.step_radius_m = std::max(a.bore_radius_m, b.bore_radius_m);
    const double height_m = junction.step_radius_m - std::min(a.bore_radius_m, b.bore_radius_m);
    junction.step_cell_m =
        std::min(height_m, 0.5 * (junction.small_radius_m - junction.step_radius_m)) / n_half_arc;
  }
  if (a.radius_m == b.radius_m) return junction;

  const double step_m = big.radius_m - junction.small_radius_m;
  junction.fillet_m = shaft.fillets_m[left];
  junction.has_shoulder_face = step_m - junction.fillet_m > 1e-9 * big.radius_m;
  if (junction.fillet_m == 0) {
    junction.kind = Junction::Kind::sharp;
    junction.first_cell_m = std::min(step_m, 0.4 * junction.small_radius_m) / n_half_arc;
    return junction;
  }
  junction.kind = Junction::Kind::fillet;
  junction.top_radius_m =
      junction.has_shoulder_face ? junction.small_radius_m + junction.fillet_m : big.radius_m;
  junction.first_cell_m = 0.25 * pi * junction.fillet_m / n_half_arc;
  return junction;
}

/// Gives the fans of a short groove one depth and one division: the rows must lie alike at both ends.
void match_fans_of_grooves(ShaftLayout& layout, double ratio) {
  for (std::size_t i = 1; i + 1 < layout.segments.size(); ++i) {
    const SegmentLayout& groove = layout.segments[i];
    Junction& left = layout.junctions[i - 1];
    Junction& right = layout.junctions[i];
    const auto is_small = [&](const Junction& j) { return j.has_fan() && j.small == static_cast<int>(i); };
    if (!is_small(left) || !is_small(right)) continue;
    const double bare_m = groove.end_m - groove.begin_m - groove.own_fillet_begin_m - groove.own_fillet_end_m;
    if (bare_m > groove.wall_m()) continue;
    const auto must_of = [&](const Junction& j, double depth_m) {
      const double must = zone_offset_of(j, layout.segments[j.big]) / depth_m;
      return must > 0 && must < 1 - 1e-9 ? must : 0;
    };
    const double depth_m = std::min(left.depth_m, right.depth_m);
    const double must = std::max(must_of(left, depth_m), must_of(right, depth_m));
    const double first = std::min(left.first_cell_m, right.first_cell_m) / depth_m;
    for (Junction* junction : {&left, &right}) {
      junction->depth_m = depth_m;
      const double own = must_of(*junction, depth_m);
      junction->depth_fractions = fan_fractions(first, own > 0 ? own : must, ratio);
    }
  }
}

void set_columns_and_shifts(ShaftLayout& layout, const Shaft& shaft) {
  for (SegmentLayout& segment : layout.segments) {
    segment.column_begin_m = segment.begin_m;
    segment.column_end_m = segment.end_m;
    segment.inner_radius_m = segment.base_radius_m;
  }
  for (const Junction& junction : layout.junctions) {
    SegmentLayout& small = layout.segments[junction.small];
    SegmentLayout& big = layout.segments[junction.big];
    if (junction.direction > 0) {
      small.column_end_m -= junction.fillet_m;
      big.column_begin_m += junction.depth_m;
    } else {
      small.column_begin_m += junction.fillet_m;
      big.column_end_m -= junction.depth_m;
    }
    if (big.is_eccentric()) big.inner_radius_m = std::max(big.inner_radius_m, junction.top_radius_m);
  }
  if (layout.junctions.empty() && layout.segments.front().is_eccentric())
    layout.segments.front().inner_radius_m = lone_inner_radius(shaft.segments.front());
}

}  // namespace

double lone_inner_radius(const ShaftSegment& segment) {
  const double base_m = segment.bore_m > 0 ? segment.bore_m : core_share * segment.diameter_m;
  return 0.5 * (base_m + 0.3 * (segment.diameter_m - base_m));
}

ShaftMeshControl before_subdivision(const ShaftMeshControl& control) {
  const int n = control.subdivisions;
  ShaftMeshControl before = control;
  before.cells_per_fillet_quarter /= n;
  for (int& cells : before.fillet_cells) cells /= n;
  before.n_sectors /= n;
  before.growth *= n;
  before.largest_cell_m *= n;
  return before;
}

ShaftLayout subdivided(const ShaftLayout& layout, int n) {
  ShaftLayout fine = layout;
  for (SegmentLayout& segment : fine.segments) {
    segment.n_inner_rows *= n;
    segment.n_outer_rows *= n;
  }
  for (Junction& junction : fine.junctions) {
    junction.first_cell_m /= n;
    junction.step_cell_m /= n;
    junction.n_half_arc *= n;
    junction.n_floor_before_plane *= n;
    if (junction.has_fan()) junction.depth_fractions = subdivided(junction.depth_fractions, n);
  }
  return fine;
}

ShaftLayout lay_out(const Shaft& shaft, const ShaftMeshControl& control) {
  const double ratio = control.is_cut_later() ? fan_ratio_before : fan_ratio;
  ShaftLayout layout;
  layout.segments = segments_of(shaft);
  set_base_radii(layout.segments);
  const int n_junctions = static_cast<int>(layout.segments.size()) - 1;
  for (int i = 0; i < n_junctions; ++i)
    layout.junctions.push_back(junction_of(layout, shaft, i, control.cells_at(i) / 2));
  for (int i = 0; i < n_junctions; ++i)
    if (layout.junctions[i].has_fan())
      set_fan(layout.junctions[i], layout, radius_below_fan(layout, i), ratio);
  match_fans_of_grooves(layout, ratio);
  for (Junction& junction : layout.junctions) set_bore_border(junction, layout);
  set_columns_and_shifts(layout, shaft);
  set_lines(layout);
  set_rows(layout, {control.n_sectors, control.is_cut_later() ? 1 : 2, control.rows_factor});
  return layout;
}

}  // namespace meshes
