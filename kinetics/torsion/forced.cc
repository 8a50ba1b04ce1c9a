#include "kinetics/torsion/forced.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "kinetics/torsion/steady.h"
#include "kinetics/values/wrong_input.h"

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

/// Sizes of the harmonics of each edge's reduced torque, together: as it is, and without modal damping.
struct EdgeSizes {
  ArrayXd whole, local;
};

HarmonicResponse at_frequency(const PreparedTrain& p, double w, const ArrayXcd& reduced_load,
                              EdgeSizes& sizes) {
  const auto state = harmonic_state(p.reduced, p.spectrum, p.train.modal_damping_ratio, w,
                                    per_node<ArrayXcd>(p.reduced, reduced_load));
  sizes.whole += state.torque.abs();
  sizes.local += (state.torque - state.modal).abs();
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

/// Which element's torque modal damping changes most, if by more than a share that counts. In a train with
/// one elastic element it sits there.
std::optional<std::string> modal_damping_warning(const PreparedTrain& p, const EdgeSizes& sizes,
                                                 const ForcedResponse& response) {
  constexpr double counts = 0.05, rounding = 1e-9;
  if (p.train.modal_damping_ratio == 0 || sizes.whole.size() < 2) return std::nullopt;
  ArrayXd mean(sizes.whole.size());
  for (Index e = 0; e < mean.size(); ++e)
    mean[e] = std::abs(response.mean_reduced_torque_Nm[p.reduced.element_of[e]]);
  const ArrayXd whole = mean + sizes.whole, local = mean + sizes.local;
  const ArrayXd larger = whole.max(local);
  Index worst = 0;
  const double share =
      ((whole - local).abs() / larger.max(std::max(1e-300, rounding * larger.maxCoeff()))).maxCoeff(&worst);
  if (share <= counts) return std::nullopt;
  const Index element = p.reduced.element_of[worst];
  const double u = std::abs(p.reduced.link_ratio[element]);
  const auto text = [&](double reduced_Nm) {
    std::ostringstream digits;
    digits << std::setprecision(4) << reduced_Nm / u << " N m";
    return digits.str();
  };
  return "modal damping changes the torque in " + p.train.elements[std::size_t(element)].name + " from " +
         text(local[worst]) + " (its own stiffness and damping on its twist) to " + text(whole[worst]) +
         ", which balances its neighbours: a modal ratio does not say where its damping sits; give "
         "elements damping or loss_factor";
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
  EdgeSizes sizes{ArrayXd::Zero(p.reduced.n_edges()), ArrayXd::Zero(p.reduced.n_edges())};
  for (std::size_t k = 0; k < lines.size();) {
    const double w = lines[k].frequency_rad_s;
    ArrayXcd load = ArrayXcd::Zero(p.reduced.ratio.size());
    for (; k < lines.size() && lines[k].frequency_rad_s <= w * (1 + 1e-14); ++k)
      load[lines[k].inertia] += lines[k].amplitude_Nm * p.reduced.ratio[lines[k].inertia];
    if ((load == 0.0).all()) continue;
    frequencies_rad_s.push_back(w);
    response.harmonics.push_back(at_frequency(p, w, load, sizes));
  }
  response.period_s = common_period_s(frequencies_rad_s);
  if (const auto warning = modal_damping_warning(p, sizes, response)) response.warnings.push_back(*warning);
  if (response.rigid_acceleration_rad_s2 != 0)
    response.warnings.push_back(
        "the constant torques do not balance: they accelerate the reference shaft by " +
        rounded(response.rigid_acceleration_rad_s2) + " rad/s2; the twist is that of the accelerated train");
  return response;
}

}  // namespace kinetics::torsion

namespace kinetics {

ForcedResponse forced_response(const DriveTrain& train) {
  const torsion::PreparedTrain prepared(train);
  const auto excitation = torsion::spectral(train, prepared.reduced);
  auto warnings = torsion::resonance_warnings(prepared, excitation.lines);
  ForcedResponse response = torsion::respond(prepared, excitation);
  warnings.insert(warnings.end(), response.warnings.begin(), response.warnings.end());
  response.warnings = std::move(warnings);
  return response;
}

}  // namespace kinetics
