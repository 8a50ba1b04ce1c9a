#include "pipelines/loads/channels/statics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipelines/base/common/constants.h"

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
    Resultant6 sum{};
    for (const auto& segment : shaft.segments) {
      const double end = std::min(segment.end_m, z_m);
      if (end <= segment.begin_m) break;
      const double length = end - segment.begin_m, centre = 0.5 * (segment.begin_m + end);
      // The disc about its own, shifted axis, less the bore about the z axis.
      const auto add = [&](double diameter, double sign, double ex, double ey) {
        const double radius = diameter / 2, mass = sign * density_kg_m3 * pi * radius * radius * length;
        add_slice(sum, load.field, {mass, mass * radius * radius / 2, ex, ey, centre});
      };
      add(segment.diameter_m, 1, segment.eccentricity_m * std::cos(segment.eccentricity_angle_rad),
          segment.eccentricity_m * std::sin(segment.eccentricity_angle_rad));
      if (segment.bore_m > 0) add(segment.bore_m, -1, 0, 0);
    }
    for (std::size_t i = 0; i < shaft.fillets_m.size(); ++i)
      if (shaft.fillets_m[i] > 0) add_fillet(sum, load.field, i);
    return sum;
  }

private:
  /// A piece of the body along z, on an axis of its own.
  struct Slice {
    double mass_kg, polar_inertia_kg_m2;  ///< the latter about its own axis
    double x_m, y_m, z_m;                 ///< centre of the slice
  };

  void add_slice(Resultant6& sum, fem::BodyForce::Field field, const Slice& slice) const {
    using Field = fem::BodyForce::Field;
    const double mass = slice.mass_kg, x = slice.x_m, y = slice.y_m;
    const auto add = [&](const std::array<double, 3>& force) { add_force(sum, force, x, y, slice.z_m, z_m); };
    switch (field) {
      case Field::translation_x:
        return add({mass, 0, 0});
      case Field::translation_y:
        return add({0, mass, 0});
      case Field::translation_z:
        return add({0, 0, mass});
      case Field::rotation:  // the centre's share as a force through it, the rest as a couple
        sum[5] += slice.polar_inertia_kg_m2;
        return add({-mass * y, mass * x, 0});
      case Field::spin:
        return add({mass * x, mass * y, 0});
    }
  }

  /// The ring between a fillet and the thinner one of its neighbours: slices along its arc by Gauss' rule.
  void add_fillet(Resultant6& sum, fem::BodyForce::Field field, std::size_t shoulder) const {
    constexpr std::array<double, 4> places{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363},
        weights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const auto &left = shaft.segments[shoulder], &right = shaft.segments[shoulder + 1];
    const bool rises = left.diameter_m < right.diameter_m;  // towards larger z
    const auto& thinner = rises ? left : right;
    const double r = thinner.diameter_m / 2, fillet = shaft.fillets_m[shoulder];
    const double x = thinner.eccentricity_m * std::cos(thinner.eccentricity_angle_rad),
                 y = thinner.eccentricity_m * std::sin(thinner.eccentricity_angle_rad);
    const double foot = left.end_m + (rises ? -fillet : fillet);  // where the arc leaves the thinner one
    const double reach = std::clamp((rises ? z_m - foot : foot - z_m) / fillet, 0.0, 1.0);
    const double from = rises ? 0 : std::asin(reach), to = rises ? std::asin(reach) : pi / 2;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double angle = 0.5 * (from + to + side * places[i] * (to - from));
        const double height = fillet * (1 - std::cos(angle)), outer = r + height;
        const double length = 0.5 * weights[i] * (to - from) * fillet * std::cos(angle);
        const double along = fillet * std::sin(angle);
        const double mass = density_kg_m3 * pi * (outer * outer - r * r) * length;
        add_slice(sum, field,
                  {mass, mass * (outer * outer + r * r) / 2, x, y, foot + (rises ? along : -along)});
      }
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
