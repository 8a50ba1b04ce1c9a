#include "meshes/shaft/row_radii.h"

#include <algorithm>
#include <cmath>

#include "meshes/spacing/grading.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

/// A row whose radius is fixed.
struct Break {
  int row = 0;
  double radius_m = 0;
};

/// Rows from the base up to `top`, finest at the top.
Radii radii_below(double core_m, double top_m, int n, double last_m) {
  const auto from_top = geometric_fractions(n, last_m / (top_m - core_m));
  Radii radii(n + 1);
  for (int k = 0; k <= n; ++k) radii[n - k] = top_m + (core_m - top_m) * from_top[k];
  radii.front() = core_m;
  return radii;
}

/// Rows between two breaks: like those of the guide (a face of the same segment, whose row `shift` is row 0
/// here), else equal.
Radii between(const Break& from, const Break& to, const Radii& guide, int shift) {
  const int n = to.row - from.row, first = from.row + shift, last = to.row + shift;
  std::vector<double> fractions = geometric_fractions(n, 1);
  if (first >= 0 && last < static_cast<int>(guide.size()))
    for (int k = 1; k < n; ++k)
      fractions[k] = (guide[first + k] - guide[first]) / (guide[last] - guide[first]);
  return spread(from.radius_m, to.radius_m, fractions);
}

/// Adds a break in its place unless one with this row is there or it would cross another.
void insert(std::vector<Break>& breaks, const Break& wanted) {
  auto at = breaks.begin();
  while (at != breaks.end() && at->row < wanted.row) ++at;
  const bool above_last = at == breaks.begin() || (at - 1)->radius_m < wanted.radius_m * (1 - tiny);
  const bool below_next =
      at == breaks.end() || (at->row > wanted.row && wanted.radius_m < at->radius_m * (1 - tiny));
  if (above_last && below_next) breaks.insert(at, wanted);
}

Radii stack(const std::vector<Break>& breaks, const Radii& guide, int shift = 0) {
  Radii radii = {breaks.front().radius_m};
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const Radii piece = between(breaks[i - 1], breaks[i], guide, shift);
    radii.insert(radii.end(), piece.begin() + 1, piece.end());
  }
  return radii;
}

class Planner {
public:
  explicit Planner(const ShaftLayout& layout)
      : layout_(layout), begin_(layout.segments.size()), end_(layout.segments.size()) {
    plan_.planes.resize(layout.junctions.size());
  }

  RadiiPlan run() {
    const int n = static_cast<int>(layout_.junctions.size());
    // From those that leave the rows least freedom to those that leave them most.
    for (int i = 0; i < n; ++i)
      if (layout_.junctions[i].has_fan()) plan_fan(i);
    for (int i = 0; i < n; ++i)
      if (layout_.junctions[i].kind == Junction::Kind::sharp && !layout_.junctions[i].is_bore_step)
        plan_sharp(i);
    for (const bool beside_fan : {true, false})
      for (int i = 0; i < n; ++i)
        if (layout_.junctions[i].is_bore_step && (has_fan(i - 1) || has_fan(i + 1)) == beside_fan)
          plan_bore_step(i);
    for (int i = 0; i < n; ++i)
      if (layout_.junctions[i].kind == Junction::Kind::flush && !layout_.junctions[i].is_bore_step)
        plan_flush(i);
    plan_.first = plain(0, layout_.segments.front().line_begin_m, guide_of(0));
    const int last = n;
    plan_.last = plain(last, layout_.segments.back().line_end_m, guide_of(last));
    return plan_;
  }

private:
  /// The face of a short segment that is planned already; empty if there is none or the segment is long.
  const Radii& guide_of(int segment) const {
    static const Radii none;
    if (!layout_.segments[segment].is_short()) return none;
    return begin_[segment].empty() ? end_[segment] : begin_[segment];
  }

  bool has_fan(int junction) const {
    return junction >= 0 && junction < static_cast<int>(layout_.junctions.size()) &&
           layout_.junctions[junction].has_fan();
  }

  /// Keeps the segment's own face at a junction as a guide for its other one.
  void keep(int junction, int segment, Radii face) {
    (segment == junction ? end_ : begin_)[segment] = std::move(face);
  }

  /// Equal rows on either side of the line, with one boundary at it.
  Radii plain(int index, double line_m, const Radii& guide) const {
    const SegmentLayout& segment = layout_.segments[index];
    std::vector<Break> breaks = {{0, segment.base_radius_m}};
    if (segment.has_line()) breaks.push_back({segment.n_inner_rows, line_m});
    breaks.push_back({segment.n_rows(), segment.radius_m});
    return stack(breaks, guide);
  }

  /// Rows of the two segments below `top_m`; lines pass at their radii.
  Radii below(int index, double top_m, int n, double last_m) const {
    const Junction& junction = layout_.junctions[index];
    const double base_m = layout_.segments[junction.small].base_radius_m;
    std::vector<Break> breaks = {{0, base_m}};
    const auto add_line = [&](int at, int segment) {
      const double line_m = layout_.line_at(at, segment);
      const int row = layout_.segments[segment].n_inner_rows;
      if (line_m > 0 && row < n && line_m < top_m * (1 - tiny)) insert(breaks, {row, line_m});
    };
    for (const int i : {junction.small, junction.big}) add_line(index, i);
    for (const int i : {junction.small, junction.big}) {  // lines at the other end of a short segment
      const int other = i == index ? index - 1 : index + 1;
      const bool passes = layout_.segments[i].is_short() && other >= 0 &&
                          other < static_cast<int>(layout_.junctions.size()) &&
                          !layout_.junctions[other].is_bore_step;
      if (passes) add_line(other, i == index ? i - 1 : i + 1);
    }
    const Radii& small_guide = guide_of(junction.small);
    const Radii& guide = small_guide.empty() ? guide_of(junction.big) : small_guide;
    if (!guide.empty()) {
      breaks.push_back({n, top_m});
      return stack(breaks, guide);
    }
    const Break& last = breaks.back();
    Radii radii = stack(breaks, {});
    const Radii graded = radii_below(last.radius_m, top_m, n - last.row, last_m);
    radii.insert(radii.end(), graded.begin() + 1, graded.end());
    return radii;
  }

  /// Rows of the big segment above row `used`, which lies at the corner or the top of the fillet.
  Radii above(int index, int used) const {
    const Junction& junction = layout_.junctions[index];
    const SegmentLayout& big = layout_.segments[junction.big];
    const double line_m = layout_.line_at(index, junction.big);
    const bool has_line =
        big.has_line() && big.n_inner_rows >= used && line_m > junction.top_radius_m * (1 - tiny);
    const double inner_top_m = has_line ? line_m : big.radius_m;
    const int n_inner = (has_line ? big.n_inner_rows : big.n_rows()) - used;
    const Radii& guide = guide_of(junction.big);
    if (!guide.empty() && !big.is_eccentric()) {
      std::vector<Break> breaks = {{used, junction.top_radius_m}};
      if (has_line && n_inner > 0) breaks.push_back({big.n_inner_rows, line_m});
      if (big.n_rows() > breaks.back().row) breaks.push_back({big.n_rows(), big.radius_m});
      return stack(breaks, guide);
    }
    const double first_m = 4 * junction.first_cell_m;
    Radii radii = {junction.top_radius_m};
    if (n_inner > 0)
      radii = spread(junction.top_radius_m, inner_top_m,
                     geometric_fractions(n_inner, first_m / (inner_top_m - junction.top_radius_m)));
    if (has_line) {
      const auto outer =
          spread(inner_top_m, big.radius_m,
                 geometric_fractions(big.n_outer_rows, first_m / (big.radius_m - inner_top_m)));
      radii.insert(radii.end(), outer.begin() + 1, outer.end());
    }
    return radii;
  }

  void plan_fan(int index) {
    const Junction& junction = layout_.junctions[index];
    const double d = junction.depth_m, floor_m = junction.small_radius_m - d;
    const double last_m = d * (1 - *(junction.depth_fractions.end() - 2));
    const int n_below = layout_.segments[junction.small].n_rows() - junction.n_depth();
    PlaneRadii& plane = plan_.planes[index];
    plane.below = below(index, floor_m, n_below, last_m);
    plane.above = above(index, n_below + junction.n_half_arc);

    Radii small = plane.below, big = plane.below;
    for (int k = junction.n_depth() - 1; k >= 0; --k)
      small.push_back(junction.small_radius_m - d * junction.depth_fractions[k]);
    for (int k = 1; k <= junction.n_half_arc; ++k)
      big.push_back(floor_m + (junction.top_radius_m - floor_m) * k / junction.n_half_arc);
    big.insert(big.end(), plane.above.begin() + 1, plane.above.end());
    keep(index, junction.small, std::move(small));
    keep(index, junction.big, std::move(big));
  }

  void plan_sharp(int index) {
    const Junction& junction = layout_.junctions[index];
    PlaneRadii& plane = plan_.planes[index];
    const int n = layout_.segments[junction.small].n_rows();
    plane.below = below(index, junction.small_radius_m, n, junction.first_cell_m);
    plane.above = above(index, n);
    Radii big = plane.below;
    big.insert(big.end(), plane.above.begin() + 1, plane.above.end());
    keep(index, junction.small, plane.below);
    keep(index, junction.big, std::move(big));
  }

  void plan_flush(int index) {
    const bool by_left = layout_.segments[index].has_line() || !layout_.segments[index + 1].has_line();
    const int segment = by_left ? index : index + 1;
    const Radii& left_guide = guide_of(index);
    const Radii& guide = left_guide.empty() ? guide_of(index + 1) : left_guide;
    PlaneRadii& plane = plan_.planes[index];
    plane.below = plain(segment, layout_.line_at(index, segment), guide);
    plane.above = {plane.below.back()};
    keep(index, index, plane.below);
    keep(index, index + 1, plane.below);
  }

  void plan_bore_step(int index) {
    const Junction& junction = layout_.junctions[index];
    const SegmentLayout& narrow = layout_.segments[junction.narrow];
    const SegmentLayout& wide = layout_.segments[junction.wide];
    const int low = rows_below_step(layout_, junction);
    const bool wide_is_small = junction.kind != Junction::Kind::flush && junction.small == junction.wide;
    const int top = wide_is_small ? low + wide.n_rows() : narrow.n_rows();

    std::vector<Break> breaks = {{0, narrow.base_radius_m}};
    if (low > 0) breaks.push_back({low, junction.step_radius_m});
    const auto add_line = [&](int row, double line_m) {  // the line of another bore step
      if (row < top && line_m < junction.small_radius_m * (1 - tiny)) insert(breaks, {row, line_m});
    };
    if (wide.has_line()) add_line(low + wide.n_inner_rows, layout_.line_at(index, junction.wide));
    const Radii &narrow_guide = guide_of(junction.narrow), &wide_guide = guide_of(junction.wide);
    const auto at_fan = [&](int segment) { return has_fan(segment == index ? index - 1 : index + 1); };
    const bool by_wide =
        !wide_guide.empty() && (narrow_guide.empty() || (at_fan(junction.wide) && !at_fan(junction.narrow)));
    if (low == 0 && narrow.has_line() && !by_wide)
      add_line(narrow.n_inner_rows, layout_.line_at(index, junction.narrow));
    breaks.push_back({top, junction.small_radius_m});
    PlaneRadii& plane = plan_.planes[index];
    plane.below = by_wide ? stack(breaks, wide_guide, -low) : stack(breaks, narrow_guide);
    plane.above = {plane.below.back()};
    if (junction.kind != Junction::Kind::flush) plane.above = above(index, wide_is_small ? top : top - low);

    Radii of_narrow = plane.below, of_wide(plane.below.begin() + low, plane.below.end());
    if (junction.kind != Junction::Kind::flush) {
      Radii& of_big = wide_is_small ? of_narrow : of_wide;
      of_big.insert(of_big.end(), plane.above.begin() + 1, plane.above.end());
    }
    keep(index, junction.narrow, std::move(of_narrow));
    keep(index, junction.wide, std::move(of_wide));
  }

  const ShaftLayout& layout_;
  RadiiPlan plan_;
  std::vector<Radii> begin_, end_;  ///< faces planned so far, per segment
};

}  // namespace

Radii spread(double from, double to, const std::vector<double>& fractions) {
  Radii values;
  for (const double x : fractions) values.push_back(from + (to - from) * x);
  values.front() = from;
  values.back() = to;
  return values;
}

RadiiPlan subdivided(const RadiiPlan& plan, int n) {
  RadiiPlan fine = {subdivided(plan.first, n), subdivided(plan.last, n), {}};
  for (const PlaneRadii& plane : plan.planes)
    fine.planes.push_back({subdivided(plane.below, n), subdivided(plane.above, n)});
  return fine;
}

int rows_below_step(const ShaftLayout& layout, const Junction& junction) {
  const SegmentLayout& narrow = layout.segments[junction.narrow];
  return narrow.base_radius_m < junction.step_radius_m * (1 - tiny) ? narrow.n_inner_rows : 0;
}

RadiiPlan plan_radii(const ShaftLayout& layout) {
  return Planner(layout).run();
}

}  // namespace meshes
