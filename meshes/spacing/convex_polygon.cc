#include "meshes/spacing/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshes {

namespace {

using PlanePoint = std::array<double, 2>;

double distance_to_line(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length_squared = dx * dx + dy * dy;
  double share = 0;
  if (length_squared > 0)
    share = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length_squared, 0.0, 1.0);
  return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

/// Whether the line of one of a's edges separates the two.
bool has_separating_edge(const std::vector<PlanePoint>& a, const std::vector<PlanePoint>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const PlanePoint &from = a[i], &to = a[(i + 1) % a.size()];
    const double nx = to[1] - from[1], ny = from[0] - to[0];
    const auto side = [&](const PlanePoint& p) { return (p[0] - from[0]) * nx + (p[1] - from[1]) * ny; };
    double a_low = 0, a_high = 0;
    double b_low = std::numeric_limits<double>::infinity(), b_high = -b_low;
    for (const PlanePoint& p : a) {
      a_low = std::min(a_low, side(p));
      a_high = std::max(a_high, side(p));
    }
    for (const PlanePoint& p : b) {
      b_low = std::min(b_low, side(p));
      b_high = std::max(b_high, side(p));
    }
    if (b_low > a_high || b_high < a_low) return true;
  }
  return false;
}

}  // namespace

double convex_distance(const std::vector<PlanePoint>& a, const std::vector<PlanePoint>& b) {
  const bool has_area = a.size() > 2 || b.size() > 2;
  if (has_area && !has_separating_edge(a, b) && !has_separating_edge(b, a)) return 0;
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto* pair : {&a, &b}) {
    const auto &corners = *pair, &points = pair == &a ? b : a;
    for (const PlanePoint& p : points)
      for (std::size_t i = 0; i < corners.size(); ++i)
        least_m = std::min(least_m, distance_to_line(p, corners[i], corners[(i + 1) % corners.size()]));
  }
  return least_m;
}

}  // namespace meshes
