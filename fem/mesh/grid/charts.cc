#include "fem/mesh/grid/charts.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/base/values/constants.h"

namespace fem {

namespace {

constexpr double two_pi = 2 * pi;

double positive_angle(double angle) {
  const double a = angle < 0 ? angle + two_pi : angle;
  return a < two_pi ? a : 0.0;
}

}  // namespace

// With t = r - inner_radius, L = outer_radius - inner_radius, shift e: |p - (t/L) e| = inner_radius + t is
// the quadratic a t^2 + 2 b t - c = 0; a > 0 since |e| < L, c >= 0 outside the inner radius: one positive
// root.
Coordinates pull_back(const CylinderChart& chart, const Coordinates& point) {
  double x = point[0] - chart.axis_x_m, y = point[1] - chart.axis_y_m;
  const double ex = chart.shift_x_m, ey = chart.shift_y_m, r_inner = chart.inner_radius_m;
  const double c = x * x + y * y - r_inner * r_inner;
  if (ex * ex + ey * ey > 0 && c > 0) {
    const double length = chart.outer_radius_m - r_inner;
    const double a = 1 - (ex * ex + ey * ey) / (length * length);
    const double b = r_inner + (x * ex + y * ey) / length;
    const double root = std::sqrt(b * b + a * c);
    const double t = b > 0 ? c / (b + root) : (root - b) / a;
    const double share = std::min(t / length, 1.0);
    x -= share * ex;
    y -= share * ey;
  }
  return {std::hypot(x, y), positive_angle(std::atan2(y, x)), point[2]};
}

Coordinates push_forward(const CylinderChart& chart, const Coordinates& chart_point) {
  const double r = chart_point[0];
  double x = chart.axis_x_m + r * std::cos(chart_point[1]), y = chart.axis_y_m + r * std::sin(chart_point[1]);
  if (chart.shift_x_m != 0 || chart.shift_y_m != 0) {
    const double length = chart.outer_radius_m - chart.inner_radius_m;
    const double share = std::clamp((r - chart.inner_radius_m) / length, 0.0, 1.0);
    x += share * chart.shift_x_m;
    y += share * chart.shift_y_m;
  }
  return {x, y, chart_point[2]};
}

Coordinates pull_back(const TorusChart& chart, const Coordinates& point) {
  const double outward = std::hypot(point[0], point[1]) - chart.centre_radius_m;
  const double along = point[2] - chart.centre_z_m;
  return {std::hypot(outward, along), positive_angle(std::atan2(point[1], point[0])),
          positive_angle(std::atan2(-along, outward))};
}

Coordinates push_forward(const TorusChart& chart, const Coordinates& chart_point) {
  const double rho = chart.centre_radius_m + chart_point[0] * std::cos(chart_point[2]);
  return {rho * std::cos(chart_point[1]), rho * std::sin(chart_point[1]),
          chart.centre_z_m - chart_point[0] * std::sin(chart_point[2])};
}

bool is_fillet(const std::vector<TorusChart>& tori, int boundary_id) {
  return std::any_of(tori.begin(), tori.end(),
                     [&](const auto& torus) { return torus.boundary_id == boundary_id; });
}

void refuse_impossible(const CylinderChart& chart) {
  const double shift = std::hypot(chart.shift_x_m, chart.shift_y_m);
  if (shift == 0 || (chart.inner_radius_m >= 0 && shift < chart.outer_radius_m - chart.inner_radius_m))
    return;
  std::ostringstream message;
  message << "chart of volume " << chart.volume_id << ": a shift of " << shift
          << " m does not fit between the radii " << chart.inner_radius_m << " and " << chart.outer_radius_m
          << " m";
  throw std::invalid_argument(message.str());
}

void refuse_impossible(const TorusChart& chart) {
  if (chart.radius_m > 0 && chart.centre_radius_m >= 0) return;
  std::ostringstream message;
  message << "torus of boundary group " << chart.boundary_id << ": its radius " << chart.radius_m
          << " m must be positive and its centre's " << chart.centre_radius_m << " m not negative";
  throw std::invalid_argument(message.str());
}

}  // namespace fem
