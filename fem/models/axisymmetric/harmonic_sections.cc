#include "fem/models/axisymmetric/harmonic_sections.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "fem/base/values/constants.h"
#include "fem/mesh/grid/charts.h"

namespace fem {
namespace {

/// On curved surface about the z axis.
bool has_rings(const SurfaceEdge& edge, const MeridianGrid& grid, const MeridianBody& body) {
  if (is_fillet(body.tori, edge.boundary_id)) return true;
  const auto& a = grid.results[std::size_t(edge.result_points[0])];
  const auto& b = grid.results[std::size_t(edge.result_points[2])];
  if (std::abs(a.z_m - b.z_m) <= 1e-6 * std::abs(a.r_m - b.r_m)) return false;
  const double middle_m = (a.z_m + b.z_m) / 2;
  return std::none_of(body.eccentric.begin(), body.eccentric.end(),
                      [&](const auto& c) { return c.begin_m < middle_m && middle_m < c.end_m; });
}

int point_at(const MeridianGrid& grid, const SectionPlane& plane) {
  const double tolerance = 1e-6 * plane.radius_m;
  for (std::size_t i = 0; i < grid.results.size(); ++i)
    if (std::abs(grid.results[i].z_m - plane.z_m) <= tolerance &&
        std::abs(grid.results[i].r_m - plane.radius_m) <= tolerance)
      return int(i);
  throw std::invalid_argument("section plane z = " + std::to_string(plane.z_m) + " m: no node on its rim");
}

}  // namespace

HarmonicSections::HarmonicSections(const MeridianGrid& grid, const MeridianBody& body,
                                   const std::vector<SectionPlane>& planes, UnitResponses& responses)
    : grid_(&grid), material_(body.material) {
  const std::size_t n_channels = responses.channels.size();
  responses.planes = planes;
  for (const auto& plane : planes) {
    rim_points_.push_back(point_at(grid, plane));
    responses.plane_area_m2.push_back(
        pi * (plane.radius_m * plane.radius_m - plane.inner_radius_m * plane.inner_radius_m));
  }
  responses.sections.assign(planes.size() * n_channels, {});

  std::map<int, std::pair<bool, int>> group;  // by point: not a fillet, id; the smallest wins
  for (const auto& edge : grid.edges) {
    if (!has_rings(edge, grid, body)) continue;
    const std::pair<bool, int> candidate(!is_fillet(body.tori, edge.boundary_id), edge.boundary_id);
    for (const int point : edge.result_points) {
      const auto known = group.emplace(point, candidate).first;
      known->second = std::min(known->second, candidate);
    }
  }
  for (const auto& [point, id] : group) ring_points_.push_back(point);
  const auto key = [&](int point) {
    const auto& p = grid.results[std::size_t(point)];
    return std::make_tuple(p.z_m, p.r_m, point);
  };
  std::sort(ring_points_.begin(), ring_points_.end(), [&](int a, int b) { return key(a) < key(b); });
  for (const int point : ring_points_) {
    const auto& p = grid.results[std::size_t(point)];
    responses.rings.push_back({p.z_m, p.r_m, group.at(point).second});
  }
  responses.ring_shear_Pa.assign(ring_points_.size() * n_channels, {});
}

void HarmonicSections::add(int m, const std::vector<HarmonicPart>& parts, const Eigen::MatrixXd& displacement,
                           const Amplitudes& amplitudes, UnitResponses& responses) const {
  if (m > 1) return;
  for (std::size_t p = 0; p < grid_->planes.size(); ++p) add_resultants(p, m, parts, displacement, responses);
  if (m == 0) add_shear(parts, amplitudes, responses);
}

void HarmonicSections::add_resultants(std::size_t plane, int m, const std::vector<HarmonicPart>& parts,
                                      const Eigen::MatrixXd& displacement, UnitResponses& responses) const {
  const auto elasticity = elasticity_matrix(material_);
  const double around = angle_integral(m);
  double area_m2 = 0, second_m4 = 0;                                       // integrals of 1 and r^2
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(9, displacement.cols());     // amplitudes
  Eigen::ArrayXXd levers = Eigen::ArrayXXd::Zero(9, displacement.cols());  // times r
  for (const auto& p : grid_->planes[plane].points) {
    const Eigen::ArrayXXd a =
        p.weight * p.r_m * amplitudes_at(p, *grid_, elasticity, m, displacement).array();
    sum += a;
    levers += p.r_m * a;
    area_m2 += 2 * pi * p.weight * p.r_m;
    second_m4 += 2 * pi * p.weight * p.r_m * p.r_m * p.r_m;
  }
  const auto& axis = responses.planes[plane];
  const double ax = axis.axis_x_m, ay = axis.axis_y_m;
  for (Eigen::Index k = 0; k < displacement.cols(); ++k) {
    const auto [channel, turned] = parts[std::size_t(k)];
    auto& r = responses.sections[plane * responses.channels.size() + channel];
    if (m == 0) {
      r.resultant[2] += around * sum(5, k);
      r.resultant[5] += around * levers(8, k);
      const double turn = around * levers(1, k) / second_m4;
      r.rotation_rad[2] += turn;
      r.translation_m[0] -= turn * ay;
      r.translation_m[1] += turn * ax;
      r.translation_m[2] += around * sum(2, k) / area_m2;
      continue;
    }
    // The mean square of x over the section is half of that of r.
    const double across = around * (sum(0, k) - sum(1, k)) / area_m2;
    const double tilt = around * levers(2, k) / (second_m4 / 2);
    r.resultant[turned ? 1 : 0] += around * (sum(6, k) - sum(8, k));
    r.resultant[turned ? 3 : 4] += (turned ? around : -around) * levers(5, k);
    r.rotation_rad[turned ? 0 : 1] += turned ? tilt : -tilt;
    r.translation_m[turned ? 1 : 0] += across;
    r.translation_m[2] += tilt * (turned ? ay : ax);
  }
}

void HarmonicSections::add_shear(const std::vector<HarmonicPart>& parts, const Amplitudes& amplitudes,
                                 UnitResponses& responses) const {
  const std::size_t n_channels = responses.channels.size();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto at = [&](int point, int c) { return amplitudes(point, Eigen::Index(9 * k) + c); };
    for (std::size_t p = 0; p < rim_points_.size(); ++p) {
      auto& mean = responses.sections[p * n_channels + parts[k].channel].mean_rim_shear_Pa;
      mean[0] += at(rim_points_[p], 7);
      mean[1] += at(rim_points_[p], 8);
    }
    for (std::size_t r = 0; r < ring_points_.size(); ++r) {
      auto& mean = responses.ring_shear_Pa[r * n_channels + parts[k].channel];
      mean[0] += at(ring_points_[r], 7);
      mean[1] += at(ring_points_[r], 8);
    }
  }
}

}  // namespace fem
