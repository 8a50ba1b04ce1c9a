#include "pipelines/statics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pipelines {
namespace {

using Resultant6 = std::array<double, 6>;

/// Adds a force (fx, fy) acting at height z_force and through (x, y) to a resultant about (0, 0, z).
void add_force(Resultant6& sum, double fx, double fy, double x, double y, double z_force, double z) {
  sum[0] += fx;
  sum[1] += fy;
  sum[3] -= (z_force - z) * fy;
  sum[4] += (z_force - z) * fx;
  sum[5] += x * fy - y * fx;
}

/// The loads on the part below z, as a resultant about (0, 0, z).
struct LoadBelow {
  const meshes::Shaft& shaft;
  double density_kg_m3, z_m;

  Resultant6 operator()(const fem::SurfaceResultant& load) const {
    using Component = fem::SurfaceResultant::Component;
    const auto& surface = load.surface;
    if (surface.kind != fem::LoadSurface::Kind::seat)
      throw std::invalid_argument("statics: only seats carry load on a shaft");
    const double begin = surface.centre_m[2] - surface.length_m / 2;
    const double share = std::clamp((z_m - begin) / surface.length_m, 0.0, 1.0);
    Resultant6 sum{};
    switch (load.component) {
      case Component::fx:
      case Component::fy: {
        const bool along_x = load.component == Component::fx;
        add_force(sum, along_x ? share : 0, along_x ? 0 : share, surface.centre_m[0], surface.centre_m[1],
                  begin + share * surface.length_m / 2, z_m);
        return sum;
      }
      case Component::torque: {
        const double zeta = 2 * share - 1;  // integral of 3/4 (1 - zeta^2)
        sum[5] = 0.5 + 0.75 * (zeta - zeta * zeta * zeta / 3);
        return sum;
      }
      default:
        throw std::invalid_argument("statics: a seat of the shaft carries fx, fy and torque only");
    }
  }

  Resultant6 operator()(const fem::SeatPressure&) const { return {}; }

  Resultant6 operator()(const fem::BodyForce& load) const {
    using Field = fem::BodyForce::Field;
    Resultant6 sum{};
    for (const auto& segment : shaft.segments) {
      const double end = std::min(segment.end_m, z_m);
      if (end <= segment.begin_m) break;
      const double radius = segment.diameter_m / 2, e = segment.eccentricity_m;
      const double mass = density_kg_m3 * M_PI * radius * radius * (end - segment.begin_m);
      const double centre = 0.5 * (segment.begin_m + end);
      switch (load.field) {
        case Field::translation_x:
          add_force(sum, mass, 0, e, 0, centre, z_m);
          break;
        case Field::translation_y:
          add_force(sum, 0, mass, e, 0, centre, z_m);
          break;
        case Field::translation_z:
          throw std::invalid_argument("statics: the shaft has no axial acceleration");
        case Field::rotation:  // the centre's share as a force through (e, 0), the rest as a couple
          add_force(sum, 0, mass * e, e, 0, centre, z_m);
          sum[5] += mass * radius * radius / 2;
          break;
        case Field::spin:
          add_force(sum, mass * e, 0, e, 0, centre, z_m);
          break;
      }
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
