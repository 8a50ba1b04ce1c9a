#include "meshes/chamber/pad_contact.h"

#include <algorithm>
#include <cmath>

namespace meshes {

namespace {

// An edge of the lug that ends nearer to the pad's corner runs to the corner.
const double side_snap_share = 0.2, width_snap_share = 0.25;
const double smallest_cosine = 0.55;  // between a side's normal and the lug: 33 degrees to the side

/// A corner or end of what the lug sees of the pad, relative to the foot.
struct SeenPoint {
  double offset_m = 0;
  PlanePoint at{};
};

/// The corners between the sides that face the tube, ascending in offset: two or three.
std::vector<SeenPoint> seen_corners(const ChamberPads& pads, const PlanePoint& away, const PlanePoint& left) {
  const double x = (away[0] > 0 ? -0.5 : 0.5) * pads.size_x_m, y = (away[1] > 0 ? -0.5 : 0.5) * pads.size_y_m;
  const bool sees_x = std::abs(away[0]) >= smallest_cosine, sees_y = std::abs(away[1]) >= smallest_cosine;
  std::vector<PlanePoint> corners = {{x, y}};
  if (sees_x) corners.push_back({x, -y});
  if (sees_y) corners.push_back({-x, y});
  std::vector<SeenPoint> seen;
  for (const PlanePoint& corner : corners)
    seen.push_back({corner[0] * left[0] + corner[1] * left[1], corner});
  std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.offset_m < b.offset_m; });
  return seen;
}

SeenPoint between(const SeenPoint& a, const SeenPoint& b, double offset_m) {
  const double share = (offset_m - a.offset_m) / (b.offset_m - a.offset_m);
  return {offset_m, {a.at[0] + share * (b.at[0] - a.at[0]), a.at[1] + share * (b.at[1] - a.at[1])}};
}

/// Where an edge of the lug ends; the offset lies within what is seen.
SeenPoint edge_end(const std::vector<SeenPoint>& seen, double offset_m, double width_m) {
  std::size_t i = 0;
  while (i + 2 < seen.size() && offset_m > seen[i + 1].offset_m) ++i;
  const SeenPoint hit = between(seen[i], seen[i + 1], offset_m);
  const double side_m = std::hypot(seen[i + 1].at[0] - seen[i].at[0], seen[i + 1].at[1] - seen[i].at[1]);
  const double snap_m = std::min(side_snap_share * side_m, width_snap_share * width_m);
  const double from_first_m = std::hypot(hit.at[0] - seen[i].at[0], hit.at[1] - seen[i].at[1]);
  if (from_first_m < snap_m) return seen[i];
  if (side_m - from_first_m < snap_m) return seen[i + 1];
  return hit;
}

}  // namespace

PadContact pad_contact(const Chamber& chamber, const ChamberFoot& foot, double direction_rad) {
  const PlanePoint away = {std::cos(direction_rad), std::sin(direction_rad)}, left = {-away[1], away[0]};
  const std::vector<SeenPoint> seen = seen_corners(chamber.pads, away, left);
  const double first_m = seen.front().offset_m, last_m = seen.back().offset_m;
  const double width_m = std::min(chamber.lugs.width_m, last_m - first_m);
  // Where the lug takes all that is seen, rounding may put the second limit below the first.
  const double low_m = std::clamp(-0.5 * width_m, first_m, std::max(first_m, last_m - width_m));
  const SeenPoint low = edge_end(seen, low_m, width_m);
  const SeenPoint high = edge_end(seen, std::min(low_m + width_m, last_m), width_m);

  PadContact contact;
  const auto add = [&](const SeenPoint& point) {
    contact.offsets_m.push_back(point.offset_m);
    contact.points.push_back({foot.x_m + point.at[0], foot.y_m + point.at[1]});
  };
  add(low);
  if (seen.size() == 3 && low.offset_m < seen[1].offset_m && seen[1].offset_m < high.offset_m) add(seen[1]);
  add(high);
  return contact;
}

}  // namespace meshes
