#include <array>
#include <stdexcept>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/constants.h"
#include "fem/models/axisymmetric/harmonic_loads.h"

namespace fem {
namespace {

using Eigen::Vector3d;

/// The resultant of a body force about the origin: the integrals of rho a and rho r x a.
std::array<double, 6> wanted_resultant(BodyForce::Field field, const MassProperties& masses) {
  using Field = BodyForce::Field;
  const double m = masses.mass_kg;
  const auto& s = masses.first_moment_kg_m;
  const auto& [xx, yy, zz, xy, yz, xz] = masses.second_moments_kg_m2;
  switch (field) {
    case Field::translation_x:
      return {m, 0, 0, 0, s[2], -s[1]};
    case Field::translation_y:
      return {0, m, 0, -s[2], 0, s[0]};
    case Field::translation_z:
      return {0, 0, m, s[1], -s[0], 0};
    case Field::rotation:
      return {-s[1], s[0], 0, -xz, -yz, xx + yy};
    case Field::spin:
      return {s[0], s[1], 0, -yz, xz, 0};
  }
  throw std::logic_error("unknown body force");
}

}  // namespace

HarmonicLoads::Basis HarmonicLoads::basis_of(const EccentricCylinder& cylinder) const {
  const double centre = (cylinder.begin_m + cylinder.end_m) / 2;
  return basis(points_between(cylinder.begin_m, cylinder.end_m), centre, rigid_tractions(centre));
}

HarmonicForces HarmonicLoads::forces_of(const BodyForce& load) const {
  using Field = BodyForce::Field;
  if (!load.volume_ids.empty())
    throw std::invalid_argument("a body of revolution has no parts; give no volume groups");
  const double density = body_->material.density_kg_m3;
  const auto &still = mass_modes_[0], &tilting = mass_modes_[1];
  HarmonicForces forces;
  switch (load.field) {
    case Field::translation_x:
      add_to(forces, 1, false, tilting.col(0));
      break;
    case Field::translation_y:
      add_to(forces, 1, true, tilting.col(0));
      break;
    case Field::translation_z:
      add_to(forces, 0, false, still.col(0));
      break;
    case Field::rotation:
      add_to(forces, 0, false, still.col(1));
      break;
    case Field::spin:
      add_to(forces, 0, false, integrate(points_between(-1e300, 1e300), 0, [&](const auto& p) {
               return Vector3d(density * p.r_m, 0, 0);
             }));
      break;
  }
  for (const auto& c : body_->eccentric) {
    const Basis own = basis_of(c);
    const double x = c.axis_x_m, y = c.axis_y_m;
    const double mass = density * pi * c.radius_m * c.radius_m * (c.end_m - c.begin_m);
    switch (load.field) {
      case Field::translation_x:
        add_to(forces, 0, false, -y * mass * own.torque);
        break;
      case Field::translation_y:
        add_to(forces, 0, false, x * mass * own.torque);
        break;
      case Field::translation_z:
        add_to(forces, 1, false, -x * mass * own.couple);
        add_to(forces, 1, true, -y * mass * own.couple);
        break;
      case Field::rotation:
        add_to(forces, 0, false, (x * x + y * y) * mass * own.torque);
        add_to(forces, 1, false, -y * mass * own.force);
        add_to(forces, 1, true, x * mass * own.force);
        break;
      case Field::spin:
        add_to(forces, 1, false, x * mass * own.force);
        add_to(forces, 1, true, y * mass * own.force);
        break;
    }
  }
  if (body_->masses_of_loads) make_resultant(wanted_resultant(load.field, *body_->masses_of_loads), forces);
  return forces;
}

void HarmonicLoads::make_resultant(const std::array<double, 6>& wanted, HarmonicForces& forces) const {
  const auto is = resultant(forces);
  std::array<double, 6> missing;
  for (std::size_t c = 0; c < 6; ++c) missing[c] = wanted[c] - is[c];
  const auto make = [&](int m, bool turned, double force, double couple) {
    if (force == 0 && couple == 0) return;
    const auto &rigid = modes_[std::size_t(m)], &mass = mass_modes_[std::size_t(m)];
    const Eigen::Vector2d acceleration =
        solve(transposed_product(rigid, mass), Eigen::Vector2d(force, couple));
    add_to(forces, m, turned, product(mass, acceleration));
  };
  make(0, false, missing[2], missing[5]);
  make(1, false, missing[0], missing[4]);
  make(1, true, missing[1], -missing[3]);
}

}  // namespace fem
