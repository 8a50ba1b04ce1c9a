#include "meshes/shaft_layout.h"

#include <algorithm>
#include <cmath>

#include "meshes/grading.h"

namespace meshes {

namespace {

const double pi = std::acos(-1.0);

const double core_share = 0.6;  // of the smallest radius
const double fan_depth = 3;     // in fillets, where there is room
const double fan_ratio = 1.6;   // growth of the cells from the arc into the fan
// Away from the arc stress varies slowly, and every row runs on into the thicker segments: few rows, growing
// fast.
const double rows_ratio = 3;
const double first_above = 13;  // of the rows above a fan, in cells of the arc
const double first_below = 7;   // of the rows below a fan, in the fan's last cell

/// Cell boundaries of the fan from the arc outwards; a boundary at `must` (a fraction, 0: none) is forced.
std::vector<double> fan_fractions(double first, double must) {
  const int n = geometric_count(1, first, fan_ratio);
  if (must <= 0 || must >= 1) return geometric_fractions(n, first);
  const int n_near = geometric_count(must, first, fan_ratio);
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
    segment.shift_m = from.eccentricity_m;
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

/// Depth of the fan: twice the fillet where the small segment's ring and the big segment's length leave room;
/// moved onto the big segment's loaded zone where that begins close by.
double depth_of(const Junction& junction, const SegmentLayout& big, double core_radius_m,
                double zone_offset_m) {
  const double depth_m =
      std::min({fan_depth * junction.fillet_m, 0.5 * (junction.small_radius_m - core_radius_m),
                0.3 * (big.end_m - big.begin_m)});
  const bool close_by = zone_offset_m >= 0.6 * depth_m && zone_offset_m <= 1.3 * depth_m;
  return close_by ? zone_offset_m : depth_m;
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
  if (a.radius_m == b.radius_m) return junction;

  const double step_m = big.radius_m - junction.small_radius_m;
  junction.n_half_arc = n_half_arc;
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
  const double zone_offset_m = !big.is_port             ? 0
                               : junction.direction > 0 ? big.zone_begin_m - big.begin_m
                                                        : big.end_m - big.zone_end_m;
  junction.depth_m = depth_of(junction, big, layout.core_radius_m, zone_offset_m);
  junction.depth_fractions =
      fan_fractions(junction.first_cell_m / junction.depth_m, zone_offset_m / junction.depth_m);
  return junction;
}

void set_columns_and_shifts(ShaftLayout& layout) {
  for (SegmentLayout& segment : layout.segments) {
    segment.column_begin_m = segment.begin_m;
    segment.column_end_m = segment.end_m;
    segment.inner_radius_m = layout.core_radius_m;
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
}

/// How the row counts of the two segments at a junction depend on each other: big >= small + more, or equal.
struct RowRule {
  int more = 0;
  bool equal = false;
};

RowRule row_rule(const Junction& junction, const SegmentLayout& big) {
  if (junction.kind == Junction::Kind::flush) return {0, true};
  const double inner_top_m = big.is_eccentric() ? big.inner_radius_m : big.radius_m;
  const double above_m = inner_top_m - junction.top_radius_m;
  const int through = junction.kind == Junction::Kind::fillet ? junction.n_half_arc - junction.n_depth() : 0;
  if (above_m <= 1e-9 * big.radius_m) return {through, true};
  return {through + geometric_count(above_m, first_above * junction.first_cell_m, rows_ratio), false};
}

/// Row counts only ever rise, and the junctions form a chain, so this ends.
void set_rows(ShaftLayout& layout, int n_sectors) {
  for (SegmentLayout& segment : layout.segments) {
    segment.n_inner_rows = std::max(2, n_sectors / 8);
    if (segment.is_eccentric()) segment.n_outer_rows = std::max(2, n_sectors / 8);
  }
  for (const Junction& junction : layout.junctions) {
    SegmentLayout& small = layout.segments[junction.small];
    SegmentLayout& big = layout.segments[junction.big];
    if (junction.kind == Junction::Kind::fillet) {
      const double below_m = junction.small_radius_m - junction.depth_m - layout.core_radius_m;
      const double last_m = junction.depth_m * (1 - *(junction.depth_fractions.end() - 2));
      small.n_inner_rows =
          std::max(small.n_inner_rows,
                   junction.n_depth() + geometric_count(below_m, first_below * last_m, rows_ratio));
    }
    if (big.is_eccentric() && junction.kind != Junction::Kind::flush)
      big.n_outer_rows =
          std::max(big.n_outer_rows, geometric_count(big.radius_m - big.inner_radius_m,
                                                     first_above * junction.first_cell_m, rows_ratio));
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Junction& junction : layout.junctions) {
      int& small = layout.segments[junction.small].n_inner_rows;
      int& big = layout.segments[junction.big].n_inner_rows;
      const RowRule rule = row_rule(junction, layout.segments[junction.big]);
      const int big_wanted = std::max(big, small + rule.more);
      const int small_wanted = rule.equal ? big_wanted - rule.more : small;
      changed = changed || big_wanted != big || small_wanted != small;
      big = big_wanted;
      small = small_wanted;
    }
  }
  for (Junction& junction : layout.junctions)
    junction.n_below = layout.segments[junction.small].n_inner_rows -
                       (junction.kind == Junction::Kind::fillet ? junction.n_depth() : 0);
}

}  // namespace

ShaftLayout lay_out(const Shaft& shaft, const ShaftMeshControl& control) {
  ShaftLayout layout;
  layout.segments = segments_of(shaft);
  double smallest_m = layout.segments.front().radius_m;
  for (const SegmentLayout& segment : layout.segments) smallest_m = std::min(smallest_m, segment.radius_m);
  layout.core_radius_m = core_share * smallest_m;
  for (std::size_t i = 0; i + 1 < layout.segments.size(); ++i)
    layout.junctions.push_back(
        junction_of(layout, shaft, static_cast<int>(i), control.cells_per_fillet_quarter / 2));
  set_columns_and_shifts(layout);
  set_rows(layout, control.n_sectors);
  return layout;
}

}  // namespace meshes
