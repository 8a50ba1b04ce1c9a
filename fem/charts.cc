#include "fem/charts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fem {

namespace {

constexpr double two_pi = 6.283185307179586476925;

double positive_angle(double angle) {
  const double a = angle < 0 ? angle + two_pi : angle;
  return a < two_pi ? a : 0.0;
}

}  // namespace

EccentricCylinder::EccentricCylinder(const CylinderChart& chart)
    : ChartManifold<3, 3, 3>(dealii::Tensor<1, 3>({0., two_pi, 0.})), chart_(chart) {
  const double shift = std::hypot(chart.shift_x_m, chart.shift_y_m);
  if (shift > 0 && !(chart.inner_radius_m >= 0 && shift < chart.outer_radius_m - chart.inner_radius_m))
    throw std::invalid_argument("chart of volume " + std::to_string(chart.volume_id) + ": a shift of " +
                                std::to_string(shift) + " m does not fit between the radii " +
                                std::to_string(chart.inner_radius_m) + " and " +
                                std::to_string(chart.outer_radius_m) + " m");
}

std::unique_ptr<dealii::Manifold<3, 3>> EccentricCylinder::clone() const {
  return std::make_unique<EccentricCylinder>(chart_);
}

// With t = r - inner_radius, L = outer_radius - inner_radius, shift e: |p - (t/L) e| = inner_radius + t is the quadratic
// a t^2 + 2 b t - c = 0; a > 0 since |e| < L, c >= 0 outside the inner radius: one positive root.
dealii::Point<3> EccentricCylinder::pull_back(const dealii::Point<3>& point) const {
  double x = point[0], y = point[1];
  const double ex = chart_.shift_x_m, ey = chart_.shift_y_m, r_inner = chart_.inner_radius_m;
  const double c = x * x + y * y - r_inner * r_inner;
  if (ex * ex + ey * ey > 0 && c > 0) {
    const double length = chart_.outer_radius_m - r_inner;
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

dealii::Point<3> EccentricCylinder::push_forward(const dealii::Point<3>& chart_point) const {
  const double r = chart_point[0];
  double x = r * std::cos(chart_point[1]), y = r * std::sin(chart_point[1]);
  if (chart_.shift_x_m != 0 || chart_.shift_y_m != 0) {
    const double length = chart_.outer_radius_m - chart_.inner_radius_m;
    const double share = std::clamp((r - chart_.inner_radius_m) / length, 0.0, 1.0);
    x += share * chart_.shift_x_m;
    y += share * chart_.shift_y_m;
  }
  return {x, y, chart_point[2]};
}

Torus::Torus(const TorusChart& chart)
    : ChartManifold<3, 3, 3>(dealii::Tensor<1, 3>({0., two_pi, two_pi})), chart_(chart) {
  if (!(chart.radius_m > 0 && chart.centre_radius_m >= 0))
    throw std::invalid_argument("torus of boundary group " + std::to_string(chart.boundary_id) +
                                ": radius must be positive and the centre's radius not negative");
}

std::unique_ptr<dealii::Manifold<3, 3>> Torus::clone() const { return std::make_unique<Torus>(chart_); }

dealii::Point<3> Torus::pull_back(const dealii::Point<3>& point) const {
  const double outward = std::hypot(point[0], point[1]) - chart_.centre_radius_m;
  const double along = point[2] - chart_.centre_z_m;
  return {std::hypot(outward, along), positive_angle(std::atan2(point[1], point[0])),
          positive_angle(std::atan2(-along, outward))};
}

dealii::Point<3> Torus::push_forward(const dealii::Point<3>& chart_point) const {
  const double rho = chart_.centre_radius_m + chart_point[0] * std::cos(chart_point[2]);
  return {rho * std::cos(chart_point[1]), rho * std::sin(chart_point[1]),
          chart_.centre_z_m - chart_point[0] * std::sin(chart_point[2])};
}

void attach_charts(dealii::Triangulation<3>& mesh, std::vector<CylinderChart> cylinders,
                   std::vector<TorusChart> tori) {
  std::sort(cylinders.begin(), cylinders.end(),
            [](const auto& a, const auto& b) { return a.volume_id < b.volume_id; });
  std::sort(tori.begin(), tori.end(), [](const auto& a, const auto& b) { return a.boundary_id < b.boundary_id; });

  for (const auto& cell : mesh.active_cell_iterators()) cell->set_all_manifold_ids(dealii::numbers::flat_manifold_id);

  dealii::types::manifold_id manifold = 0;
  for (const auto& chart : cylinders) {
    bool found = false;
    for (const auto& cell : mesh.active_cell_iterators())
      if (static_cast<int>(cell->material_id()) == chart.volume_id) {
        cell->set_all_manifold_ids(manifold);
        found = true;
      }
    if (!found)
      throw std::invalid_argument("chart of volume " + std::to_string(chart.volume_id) +
                                  ": the mesh has no cells in this physical group");
    mesh.set_manifold(manifold++, EccentricCylinder(chart));
  }
  for (const auto& chart : tori) {
    bool found = false;
    for (const auto& cell : mesh.active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary() && static_cast<int>(cell->face(face)->boundary_id()) == chart.boundary_id) {
          cell->face(face)->set_all_manifold_ids(manifold);
          found = true;
        }
    if (!found)
      throw std::invalid_argument("torus of boundary group " + std::to_string(chart.boundary_id) +
                                  ": the mesh has no faces in this physical group");
    mesh.set_manifold(manifold++, Torus(chart));
  }
}

}  // namespace fem
