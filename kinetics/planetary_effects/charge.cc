#include <cmath>

#include "kinetics/planetary_effects/effect.h"

namespace kinetics::planetary {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

EffectLoad on_wall(const Array2Xd& force_N, const ArrayXd& moment_Nm) {
  return {Receiver::inner_wall, force_N, moment_Nm, force_N};
}

}  // namespace

Effect charge_transport(const Machine& machine) {
  const double omega = machine.mill.speed_rad_s;
  const double acceleration_m_s2 = omega * omega * machine.geometry.carrier_m;
  const double force_N = machine.charge.mass_kg * acceleration_m_s2;  // (10)
  const double moment_Nm = machine.charge.first_moment_kg_m * acceleration_m_s2 *
                           std::cos(machine.mill.charge.segment_angle_rad);  // (14), M_A
  return [=](const Instants& at) {
    return on_wall(constant_force(force_N, 0, at.size()), ArrayXd::Constant(at.size(), moment_Nm));
  };
}

Effect charge_offset(const Machine& machine) {
  const double omega = machine.offset_speed_rad_s;
  const double alpha = machine.mill.charge.segment_angle_rad;
  const double force_N = machine.charge.first_moment_kg_m * omega * omega;  // (11)
  return [=](const Instants& at) {
    return on_wall(constant_force(force_N * std::sin(alpha), -force_N * std::cos(alpha), at.size()),
                   ArrayXd::Zero(at.size()));
  };
}

Effect charge_gravity(const Machine& machine) {
  const double moment_Nm = machine.charge.first_moment_kg_m * machine.mill.gravity_m_s2;
  return [=](const Instants& at) {
    return on_wall(weight(machine.charge.mass_kg, machine, at),
                   -moment_Nm * (at.phi_rad + machine.weight_lag_rad).sin());
  };
}

}  // namespace kinetics::planetary
