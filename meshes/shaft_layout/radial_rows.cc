#include "meshes/shaft_layout/radial_rows.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "meshes/spacing/grading.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

const double first_above = 13;  // first of the rows above a fan, in cells of the arc
const double first_below = 7;   // first of the rows below a fan, in the fan's last cell
const double thin_wall = 0.3;   // as a share of the radius; thinner walls get the least number of rows

/// Number of rows times a factor.
int times(double factor, int n_rows) {
  return int(std::ceil(factor * n_rows - tiny));
}

void set_smallest_rows(SegmentLayout& segment, const RowControl& control) {
  const int least = times(control.factor, control.n_least);
  const int usual = std::max(least, times(control.factor, control.n_sectors / 8));
  const auto usual_rows = [&](double thickness_m) {
    return thickness_m < thin_wall * segment.radius_m ? least : usual;
  };
  segment.n_inner_rows = usual;
  if (segment.is_eccentric())
    segment.n_outer_rows = usual;
  else if (segment.has_line()) {
    const double line_m = std::min(segment.line_begin_m, segment.line_end_m);
    segment.n_inner_rows = usual_rows(line_m - segment.base_radius_m);
    segment.n_outer_rows = usual_rows(segment.radius_m - line_m);
  } else if (segment.is_bored()) {
    segment.n_inner_rows = usual_rows(segment.wall_m());
  }
}

/// The count that grows when the segment needs more rows below its surface.
int& topmost(SegmentLayout& segment) {
  return segment.has_line() ? segment.n_outer_rows : segment.n_inner_rows;
}

bool raise(int& count, int wanted) {
  if (count >= wanted) return false;
  count = wanted;
  return true;
}

bool raise_rows(SegmentLayout& segment, int n_rows) {
  return raise(topmost(segment), n_rows - (segment.n_rows() - topmost(segment)));
}

/// Rows for the room above a shoulder's corner or fillet: none, or at least some.
struct Room {
  bool none = false;
  int n_min = 0;
};

/// A disc that is thinner than the room is a plate that bends: its rows are at most half as high as it is
/// thick.
Room room_above(const Junction& junction, double top_m, const SegmentLayout& big) {
  const double above_m = top_m - junction.top_radius_m, length_m = big.end_m - big.begin_m;
  if (above_m <= tiny * big.radius_m) return {true, 0};
  const int n_graded = geometric_count(above_m, first_above * junction.first_cell_m, rows_ratio);
  const bool is_plate = above_m > length_m;
  return {false, is_plate ? std::max(n_graded, int(std::ceil(2 * above_m / length_m))) : n_graded};
}

/// Two lines that run through the same rows keep their order.
bool order_lines(SegmentLayout& a, double line_a_m, SegmentLayout& b, double line_b_m) {
  if (std::abs(line_a_m - line_b_m) <= tiny * a.radius_m) {
    const int n = std::max(a.n_inner_rows, b.n_inner_rows);
    return raise(a.n_inner_rows, n) | raise(b.n_inner_rows, n);
  }
  return line_a_m < line_b_m ? raise(b.n_inner_rows, a.n_inner_rows + 1)
                             : raise(a.n_inner_rows, b.n_inner_rows + 1);
}

/// `n_big` of the big segment's rows reach from the base up to a height with `room` above the corner.
bool fit_above(SegmentLayout& small, int used, int& big_count, int n_big, const Room& room) {
  bool changed = raise(big_count, big_count + (used + room.n_min - n_big));
  if (room.none && n_big > used) changed |= raise_rows(small, small.n_rows() + n_big - used);
  return changed;
}

bool fit_shoulder(ShaftLayout& layout, int index) {
  const Junction& junction = layout.junctions[index];
  SegmentLayout& small = layout.segments[junction.small];
  SegmentLayout& big = layout.segments[junction.big];
  const int n_depth = junction.has_fan() ? junction.n_depth() : 0;
  const int n_half = junction.has_fan() ? junction.n_half_arc : 0;
  const double floor_m = junction.small_radius_m - junction.depth_m;
  const double small_line_m = layout.line_at(index, junction.small);
  const double line_m = layout.line_at(index, junction.big);

  bool changed = false;
  if (small.has_line()) changed |= raise(small.n_outer_rows, n_depth + 1);
  const int used = small.n_rows() - n_depth + n_half;
  if (big.has_line() && line_m >= junction.top_radius_m * (1 - tiny))
    return fit_above(small, used, big.n_inner_rows, big.n_inner_rows, room_above(junction, line_m, big)) |
           changed;
  if (big.has_line() && line_m > floor_m * (1 - tiny)) {  // along the floor of the fan
    const int below = small.n_rows() - n_depth;
    changed |= raise(big.n_inner_rows, below) | raise_rows(small, big.n_inner_rows + n_depth);
  } else if (big.has_line()) {
    changed |= raise_rows(small, big.n_inner_rows + 1 + n_depth);
    if (small.has_line()) changed |= order_lines(small, small_line_m, big, line_m);
  }
  return fit_above(small, used, topmost(big), big.n_rows(), room_above(junction, big.radius_m, big)) |
         changed;
}

/// Above the wide bore the rows of both run through; a sharp shoulder outside adds some to the bigger.
bool fit_bore_step(ShaftLayout& layout, int index) {
  const Junction& junction = layout.junctions[index];
  SegmentLayout& narrow = layout.segments[junction.narrow];
  SegmentLayout& wide = layout.segments[junction.wide];
  const bool has_face = narrow.base_radius_m < junction.step_radius_m * (1 - tiny);
  const int n_through = has_face ? narrow.n_outer_rows : narrow.n_rows();
  if (junction.kind == Junction::Kind::flush) {
    const int n = std::max(n_through, wide.n_rows());
    return raise_rows(wide, n) | raise(topmost(narrow), topmost(narrow) + n - n_through);
  }
  SegmentLayout& big = layout.segments[junction.big];
  const bool big_is_wide = junction.big == junction.wide;
  const int n_above = room_above(junction, big.radius_m, big).n_min;
  bool changed = big_is_wide ? raise_rows(wide, n_through + n_above)
                             : raise(topmost(narrow), topmost(narrow) + wide.n_rows() + n_above - n_through);
  if (!big.has_line() || (has_face && !big_is_wide)) return changed;
  // The line of another bore step, at the other end of the big segment, passes above or below the corner.
  const double line_m = layout.line_at(index, junction.big);
  const int n_small = big_is_wide ? n_through : wide.n_rows();
  const bool above = line_m > junction.small_radius_m * (1 + tiny);
  const bool below = line_m < junction.small_radius_m * (1 - tiny);
  if (!below) changed |= raise(big.n_inner_rows, n_small + (above ? 1 : 0));
  if (!above && big.n_inner_rows + (below ? 1 : 0) > n_small) {
    SegmentLayout& small = layout.segments[junction.small];
    changed |= raise_rows(small, small.n_rows() + big.n_inner_rows + (below ? 1 : 0) - n_small);
  }
  return changed;
}

bool fit(ShaftLayout& layout, int index) {
  const Junction& junction = layout.junctions[index];
  if (junction.is_bore_step) return fit_bore_step(layout, index);
  if (junction.kind != Junction::Kind::flush) return fit_shoulder(layout, index);
  SegmentLayout& left = layout.segments[index];
  SegmentLayout& right = layout.segments[index + 1];
  const int n = std::max(left.n_rows(), right.n_rows());
  return raise_rows(left, n) | raise_rows(right, n);
}

/// Rows that a fan needs below itself, and an eccentric ring above it.
void set_rows_at_fans(ShaftLayout& layout, const Junction& junction, double factor) {
  SegmentLayout& small = layout.segments[junction.small];
  SegmentLayout& big = layout.segments[junction.big];
  if (junction.has_fan()) {
    const double below_m = junction.small_radius_m - junction.depth_m - small.base_radius_m;
    const double last_m = junction.depth_m * (1 - *(junction.depth_fractions.end() - 2));
    raise_rows(small, junction.n_depth() +
                          times(factor, geometric_count(below_m, first_below * last_m, rows_ratio)));
  }
  if (big.is_eccentric() && junction.kind != Junction::Kind::flush)
    raise(big.n_outer_rows, times(factor, geometric_count(big.radius_m - big.inner_radius_m,
                                                          first_above * junction.first_cell_m, rows_ratio)));
}

}  // namespace

void set_rows(ShaftLayout& layout, const RowControl& control) {
  for (SegmentLayout& segment : layout.segments) set_smallest_rows(segment, control);
  for (const Junction& junction : layout.junctions) set_rows_at_fans(layout, junction, control.factor);
  // Counts only ever rise, and the junctions form a chain, so this ends.
  const int n_junctions = static_cast<int>(layout.junctions.size());
  bool changed = true;
  for (int pass = 0; changed; ++pass) {
    if (pass > 1000) throw std::logic_error("shaft mesh: the rows of the segments do not fit together");
    changed = false;
    for (int i = 0; i < n_junctions; ++i) changed |= fit(layout, i);
  }
}

}  // namespace meshes
