#include "pipelines/channels/statics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipelines/common/constants.h"

namespace pipelines {
namespace {

using Resultant6 = std::array<double, 6>;

/// Adds a force acting at height z_force and through (x, y) to a resultant about (0, 0, z).
void add_force(Resultant6& sum, const std::array<double, 3>& f, double x, double y, double z_force,
               double z) {
  const double arm = z_force - z;
  for (std::size_t c = 0; c < 3; ++c) sum[c] += f[c];
  sum[3] += y * f[2] - arm * f[1];
  sum[4] += arm * f[0] - x * f[2];
  sum[5] += x * f[1] - y * f[0];
}

/// Share of a seat's axial profile that lies below zeta in [-1, 1] of its half length, and the first moment
/// of that share in half lengths. Straight lines: each piece by Simpson's rule, which is exact.
std::pair<double, double> profile_below(const std::vector<double>& profile, double zeta) {
  const auto values = profile.size() > 1 ? profile : std::vector<double>{1, 1};
  const double step = 2.0 / double(values.size() - 1);
  double share = 0, moment = 0, whole = 0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = -1 + double(i) * step;
    const auto at = [&](double x) { return values[i] + (values[i + 1] - values[i]) * (x - a) / step; };
    whole += step * (values[i] + values[i + 1]) / 2;
    const double b = std::min(a + step, zeta);
    if (b <= a) continue;
    const double m = (a + b) / 2, sixth = (b - a) / 6;
    share += sixth * (at(a) + 4 * at(m) + at(b));
    moment += sixth * (a * at(a) + 4 * m * at(m) + b * at(b));
  }
  return {share / whole, moment / whole};
}

/// The loads on the part below z, as a resultant about (0, 0, z).
struct LoadBelow {
  const meshes::Shaft& shaft;
  double density_kg_m3, z_m;

  /// A face carries its whole load at one height.
  Resultant6 on_face(const fem::SurfaceResultant& load) const {
    Resultant6 sum{};
    const auto& c = load.surface.centre_m;
    if (z_m < c[2]) return sum;
    const auto component = std::size_t(load.component);
    if (component >= 3) {
      sum[component] = 1;
      return sum;
    }
    std::array<double, 3> force{};
    force[component] = 1;
    add_force(sum, force, c[0], c[1], c[2], z_m);
    return sum;
  }

  Resultant6 operator()(const fem::SurfaceResultant& load) const {
    using Component = fem::SurfaceResultant::Component;
    const auto& surface = load.surface;
    if (surface.kind != fem::LoadSurface::Kind::seat) return on_face(load);
    const double half = surface.length_m / 2;
    const double zeta = std::clamp((z_m - surface.centre_m[2]) / half, -1.0, 1.0);
    const double tapered = 0.5 + 0.75 * (zeta - zeta * zeta * zeta / 3);  // integral of 3/4 (1 - zeta^2)
    Resultant6 sum{};
    switch (load.component) {
      case Component::fx:
      case Component::fy: {
        // A lopsided profile has a couple of its own; the unit resultant takes it out by pressure linear in
        // z.
        const auto [share, moment] = profile_below(surface.axial_profile, zeta);
        const double couple = profile_below(surface.axial_profile, 1).second;
        const double linear_share = -1.5 * couple * (zeta * zeta - 1) / 2;
        const double linear_moment = -1.5 * couple * (zeta * zeta * zeta + 1) / 3;
        const std::size_t c = load.component == Component::fx ? 0 : 1;
        std::array<double, 3> force{};
        force[c] = share + linear_share;
        add_force(sum, force, surface.centre_m[0], surface.centre_m[1], surface.centre_m[2], z_m);
        (c == 0 ? sum[4] : sum[3]) += (c == 0 ? 1 : -1) * half * (moment + linear_moment);
        return sum;
      }
      case Component::fz:
        add_force(sum, {0, 0, tapered}, surface.centre_m[0], surface.centre_m[1], surface.centre_m[2], z_m);
        return sum;
      case Component::mx:
      case Component::my: {
        // Pressure proportional to z: force per length 3 zeta / (2 half^2) across, of unit moment.
        const double force = 0.75 * (zeta * zeta - 1) / half;
        const double moment = 0.5 * (zeta * zeta * zeta + 1);
        const bool about_y = load.component == Component::my;
        add_force(sum, {about_y ? force : 0, about_y ? 0 : -force, 0}, surface.centre_m[0],
                  surface.centre_m[1], surface.centre_m[2], z_m);
        sum[about_y ? 4 : 3] += moment;
        return sum;
      }
      case Component::torque:
        sum[5] = tapered;
        return sum;
    }
    return sum;
  }

  Resultant6 operator()(const fem::SeatPressure&) const { return {}; }

  Resultant6 operator()(const fem::BodyForce& load) const {
    using Field = fem::BodyForce::Field;
    Resultant6 sum{};
    for (const auto& segment : shaft.segments) {
      const double end = std::min(segment.end_m, z_m);
      if (end <= segment.begin_m) break;
      const double length = end - segment.begin_m, centre = 0.5 * (segment.begin_m + end);
      // The disc about its own, shifted axis, less the bore about the z axis.
      const auto add = [&](double diameter, double sign, double ex, double ey) {
        const double radius = diameter / 2, mass = sign * density_kg_m3 * pi * radius * radius * length;
        switch (load.field) {
          case Field::translation_x:
            return add_force(sum, {mass, 0, 0}, ex, ey, centre, z_m);
          case Field::translation_y:
            return add_force(sum, {0, mass, 0}, ex, ey, centre, z_m);
          case Field::translation_z:
            return add_force(sum, {0, 0, mass}, ex, ey, centre, z_m);
          case Field::rotation:  // the centre's share as a force through it, the rest as a couple
            sum[5] += mass * radius * radius / 2;
            return add_force(sum, {-mass * ey, mass * ex, 0}, ex, ey, centre, z_m);
          case Field::spin:
            return add_force(sum, {mass * ex, mass * ey, 0}, ex, ey, centre, z_m);
        }
      };
      add(segment.diameter_m, 1, segment.eccentricity_m * std::cos(segment.eccentricity_angle_rad),
          segment.eccentricity_m * std::sin(segment.eccentricity_angle_rad));
      if (segment.bore_m > 0) add(segment.bore_m, -1, 0, 0);
    }
    return sum;
  }
};

}  // namespace

std::array<double, 6> internal_resultant(const fem::UnitLoad& load, const meshes::Shaft& shaft,
                                         double density_kg_m3, double z_m) {
  auto internal = std::visit(LoadBelow{shaft, density_kg_m3, z_m}, load.shape);
  for (double& component : internal) component = -component;
  return internal;
}

}  // namespace pipelines
