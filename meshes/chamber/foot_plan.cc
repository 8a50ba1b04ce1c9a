#include "meshes/chamber/foot_plan.h"

#include <algorithm>
#include <cmath>

#include "meshes/spacing/plan_blocks.h"

namespace meshes {

namespace {

/// Offsets of the lug's columns on the pad: those on the tube, stretched so that the ends are the contact's
/// and, where the lug covers the pad's corner, the inner column that comes nearest meets it.
std::vector<double> offsets_on_pad(const std::vector<double>& on_tube_m, const PadContact& contact) {
  const std::size_t last = on_tube_m.size() - 1;
  std::vector<std::size_t> fixed = {0, last};
  if (contact.offsets_m.size() == 3) {
    const double share =
        (contact.offsets_m[1] - contact.offsets_m[0]) / (contact.offsets_m[2] - contact.offsets_m[0]);
    const double wanted_m = on_tube_m[0] + share * (on_tube_m[last] - on_tube_m[0]);
    const auto closer = [&](double a, double b) { return std::abs(a - wanted_m) < std::abs(b - wanted_m); };
    const auto column = std::min_element(on_tube_m.begin() + 1, on_tube_m.end() - 1, closer);
    fixed.insert(fixed.begin() + 1, static_cast<std::size_t>(column - on_tube_m.begin()));
  }
  std::vector<double> result(on_tube_m.size());
  for (std::size_t piece = 0; piece + 1 < fixed.size(); ++piece) {
    const double a = on_tube_m[fixed[piece]], b = on_tube_m[fixed[piece + 1]];
    const double to_a = contact.offsets_m[piece], to_b = contact.offsets_m[piece + 1];
    for (std::size_t j = fixed[piece]; j <= fixed[piece + 1]; ++j)
      result[j] = to_a + (to_b - to_a) * ((on_tube_m[j] - a) / (b - a));
    result[fixed[piece]] = to_a;
    result[fixed[piece + 1]] = to_b;
  }
  return result;
}

PlanePoint contact_point(const PadContact& contact, double offset_m) {
  std::size_t i = 0;
  while (i + 2 < contact.offsets_m.size() && offset_m > contact.offsets_m[i + 1]) ++i;
  const PlanePoint &a = contact.points[i], &b = contact.points[i + 1];
  if (offset_m == contact.offsets_m[i]) return a;
  if (offset_m == contact.offsets_m[i + 1]) return b;
  const double share = (offset_m - contact.offsets_m[i]) / (contact.offsets_m[i + 1] - contact.offsets_m[i]);
  return {a[0] == b[0] ? a[0] : a[0] + share * (b[0] - a[0]),
          a[1] == b[1] ? a[1] : a[1] + share * (b[1] - a[1])};
}

/// Grid lines of the pad: its ends and the lug's columns, which have to meet cells one to one; outside them
/// no gap is wider than `size_m`.
std::vector<double> grid_lines(double begin_m, double end_m, std::vector<double> columns_m, double size_m) {
  const double tiny = 1e-9 * (end_m - begin_m);
  const auto [first, last] = std::minmax_element(columns_m.begin(), columns_m.end());
  const double lug_begin_m = *first, lug_end_m = *last;
  columns_m.push_back(begin_m);
  columns_m.push_back(end_m);
  std::sort(columns_m.begin(), columns_m.end());
  std::vector<double> lines = {begin_m};
  for (const double column_m : columns_m) {
    const double gap_m = column_m - lines.back();
    if (gap_m <= tiny) continue;
    const double from_m = lines.back();
    const bool is_outside = column_m <= lug_begin_m + tiny || from_m >= lug_end_m - tiny;
    const int n = is_outside ? std::max(1, static_cast<int>(std::ceil(gap_m / size_m - 1e-6))) : 1;
    for (int i = 1; i < n; ++i) lines.push_back(from_m + gap_m * i / n);
    lines.push_back(column_m);
  }
  return lines;
}

std::size_t nearest(const std::vector<double>& lines, double at_m) {
  const auto closer = [&](double a, double b) { return std::abs(a - at_m) < std::abs(b - at_m); };
  return static_cast<std::size_t>(std::min_element(lines.begin(), lines.end(), closer) - lines.begin());
}

}  // namespace

FootBlocks add_foot(Plan& plan, const Chamber& chamber, const ChamberLayout& layout, std::size_t foot,
                    const std::vector<int>& tube_row, const std::vector<double>& columns_rad,
                    const ToeSizes& sizes, int sole_id) {
  const FootLayout& place = layout.feet[foot];
  std::vector<double> on_tube_m;
  for (const double angle : columns_rad) on_tube_m.push_back(layout.tube_outer_m * std::sin(angle));
  std::vector<PlanePoint> ends;
  for (const double offset_m : offsets_on_pad(on_tube_m, place.contact))
    ends.push_back(contact_point(place.contact, offset_m));

  const ChamberPads& pads = chamber.pads;
  const double size_m = std::min(sizes.largest_m, 0.5 * std::min(pads.size_x_m, pads.size_y_m));
  const double x_m = chamber.feet[foot].x_m, y_m = chamber.feet[foot].y_m;
  std::vector<double> columns_x, columns_y;
  for (const PlanePoint& end : ends) {
    columns_x.push_back(end[0]);
    columns_y.push_back(end[1]);
  }
  const auto xs = grid_lines(x_m - 0.5 * pads.size_x_m, x_m + 0.5 * pads.size_x_m, columns_x, size_m);
  const auto ys = grid_lines(y_m - 0.5 * pads.size_y_m, y_m + 0.5 * pads.size_y_m, columns_y, size_m);

  PointRows columns;  // (x, y) is right-handed: one row of points for each x
  for (const double x : xs) {
    columns.emplace_back();
    for (const double y : ys) {
      columns.back().push_back(static_cast<int>(plan.points.size()));
      plan.points.push_back({x, y});
    }
  }
  FootBlocks blocks;
  add_quads(blocks.pad, columns, false, 0, 0);
  const std::size_t n_rows = ys.size() - 1;
  for (std::size_t i = 0; i < blocks.pad.quads.size(); ++i) {  // edge 0 is the lower, 2 the upper
    if (place.sole_sign < 0 && i % n_rows == 0) blocks.pad.quads[i].edge_ids[0] = sole_id;
    if (place.sole_sign > 0 && i % n_rows + 1 == n_rows) blocks.pad.quads[i].edge_ids[2] = sole_id;
  }

  std::vector<int> pad_row;
  for (const PlanePoint& end : ends) pad_row.push_back(columns[nearest(xs, end[0])][nearest(ys, end[1])]);
  const std::size_t middle = ends.size() / 2;
  const auto &a = plan.points[tube_row[middle]], &b = plan.points[pad_row[middle]];
  const double length_m = std::hypot(b[0] - a[0], b[1] - a[1]);
  std::vector<double> shares = between_toes(0, length_m, sizes, 2);
  for (double& share : shares) share /= length_m;
  add_quads(blocks.lug, add_ruled_rows(plan, tube_row, pad_row, shares), false, 0, 0);
  return blocks;
}

}  // namespace meshes
