#include "kinetics/torsion/forced.h"

#include <algorithm>
#include <complex>

#include "kinetics/torsion/steady.h"
#include "kinetics/wrong_input.h"

namespace kinetics::torsion {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;

/// Sums over the inertias of each node.
template <class Array>
Array per_node(const ReducedTrain& reduced, const Array& per_inertia) {
  Array sums = Array::Zero(reduced.n_nodes());
  for (Index i = 0; i < per_inertia.size(); ++i) sums[reduced.node_of[i]] += per_inertia[i];
  return sums;
}

template <class Array>
Array per_inertia(const ReducedTrain& reduced, const Array& per_node) {
  Array values(reduced.ratio.size());
  for (Index i = 0; i < values.size(); ++i) values[i] = per_node[reduced.node_of[i]];
  return values;
}

/// Reduced inertia and drag of each inertia by itself.
std::pair<ArrayXd, ArrayXd> own(const PreparedTrain& p) {
  const Index n = p.reduced.ratio.size();
  ArrayXd J(n), D(n);
  for (Index i = 0; i < n; ++i) {
    J[i] = p.train.inertias[i].inertia_kg_m2;
    D[i] = p.train.inertias[i].damping_N_m_s;
  }
  const ArrayXd u2 = p.reduced.ratio.square();
  return {J * u2, D * u2};
}

HarmonicResponse at_frequency(const PreparedTrain& p, double w, const ArrayXcd& reduced_load) {
  const auto state = harmonic_state(p.reduced, p.spectrum, p.train.modal_damping_ratio, w,
                                    per_node<ArrayXcd>(p.reduced, reduced_load));
  const auto [J, D] = own(p);
  const ArrayXcd q = per_inertia<ArrayXcd>(p.reduced, state.angle);
  const ArrayXcd net = reduced_load + (w * w * J) * q - std::complex<double>(0, w) * D * q;
  HarmonicResponse response;
  response.frequency_rad_s = w;
  response.angle_rad = p.reduced.ratio * q;
  response.reduced_torque_Nm = element_torques<ArrayXcd>(p.reduced, state.torque, net);
  response.torque_Nm = response.reduced_torque_Nm / p.reduced.link_ratio;
  return response;
}

void add_mean(const PreparedTrain& p, const ArrayXd& constant_Nm, ForcedResponse& response) {
  const ArrayXd load = constant_Nm * p.reduced.ratio;
  const MeanState mean = mean_state(p.reduced, per_node<ArrayXd>(p.reduced, load));
  const auto [J, D] = own(p);
  response.rigid_acceleration_rad_s2 = mean.acceleration_rad_s2;
  response.speed_offset_rad_s = mean.speed_rad_s;
  response.mean_angle_rad = p.reduced.ratio * per_inertia<ArrayXd>(p.reduced, mean.angle);
  const ArrayXd net = load - J * mean.acceleration_rad_s2 - D * mean.speed_rad_s;
  response.mean_reduced_torque_Nm = element_torques<ArrayXd>(p.reduced, mean.torque, net);
  response.mean_torque_Nm = response.mean_reduced_torque_Nm / p.reduced.link_ratio;
}

}  // namespace

PreparedTrain::PreparedTrain(const DriveTrain& given)
    : train(given),
      reduced(reduce(given)),
      spectrum(torsion::spectrum(reduced, reduced.damped() || given.modal_damping_ratio != 0)) {}

ForcedResponse respond(const PreparedTrain& p, const Spectral& excitation) {
  ForcedResponse response;
  add_mean(p, excitation.constant_Nm, response);
  std::vector<TorqueLine> lines = excitation.lines;
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.frequency_rad_s < b.frequency_rad_s; });
  std::vector<double> frequencies_rad_s;
  for (std::size_t k = 0; k < lines.size();) {
    const double w = lines[k].frequency_rad_s;
    ArrayXcd load = ArrayXcd::Zero(p.reduced.ratio.size());
    for (; k < lines.size() && lines[k].frequency_rad_s <= w * (1 + 1e-14); ++k)
      load[lines[k].inertia] += lines[k].amplitude_Nm * p.reduced.ratio[lines[k].inertia];
    if ((load == 0.0).all()) continue;
    frequencies_rad_s.push_back(w);
    response.harmonics.push_back(at_frequency(p, w, load));
  }
  response.period_s = common_period_s(frequencies_rad_s);
  return response;
}

}  // namespace kinetics::torsion

namespace kinetics {

ForcedResponse forced_response(const DriveTrain& train) {
  const torsion::PreparedTrain prepared(train);
  const auto excitation = torsion::spectral(train, prepared.reduced);
  const auto warnings = torsion::resonance_warnings(prepared, excitation.lines);
  ForcedResponse response = torsion::respond(prepared, excitation);
  response.warnings = warnings;
  if (response.rigid_acceleration_rad_s2 != 0)
    response.warnings.push_back(
        "the constant torques do not balance: they accelerate the reference shaft by " +
        number(response.rigid_acceleration_rad_s2) + " rad/s2; the twist is that of the accelerated train");
  return response;
}

}  // namespace kinetics
