#include <utility>

#include "kinetics/planetary_effects/effect.h"

namespace kinetics::planetary {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

Array2Xd constant_force(double fx_N, double fy_N, Eigen::Index n) {
  return Eigen::Array2d(fx_N, fy_N).replicate(1, n);
}

Array2Xd weight(double mass_kg, const Machine& machine, const Instants& at) {
  const double weight_N = mass_kg * machine.mill.gravity_m_s2;
  Array2Xd force_N(2, at.size());
  force_N.row(0) = -weight_N * at.phi_rad.sin().transpose();
  force_N.row(1) = -weight_N * at.phi_rad.cos().transpose();
  return force_N;
}

namespace {

EffectLoad on_drum(const Array2Xd& force_N) {
  return {Receiver::drum, force_N, ArrayXd::Zero(force_N.cols()), force_N};
}

}  // namespace

Effect drum_transport(const Machine& machine) {
  const double omega = machine.mill.speed_rad_s;
  const double force_N = machine.mill.drum_mass_kg * omega * omega * machine.geometry.carrier_m;  // (9)
  return [force_N](const Instants& at) { return on_drum(constant_force(force_N, 0, at.size())); };
}

Effect drum_gravity(const Machine& machine) {
  return [machine](const Instants& at) { return on_drum(weight(machine.mill.drum_mass_kg, machine, at)); };
}

}  // namespace kinetics::planetary
