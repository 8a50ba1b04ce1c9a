#include "kinetics/torsion/stepper.h"

namespace kinetics::torsion {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

Stepper::Stepper(const ReducedTrain& reduced, const Spectrum& spectrum, double modal_damping_ratio,
                 ArrayXd viscous, double time_step_s)
    : reduced_(reduced),
      time_step_s_(time_step_s),
      viscous_(std::move(viscous)),
      node_(2 / time_step_s * reduced.inertia + reduced.damping),
      edge_(time_step_s / 2 * reduced.stiffness + viscous_) {
  if (modal_damping_ratio == 0) {
    tree_.emplace(reduced, node_, edge_, reduced.held.value_or(0));
    return;
  }
  const Index m = reduced.n_edges();
  const MatrixXd root = reduced.stiffness.sqrt().matrix().asDiagonal() * spectrum.edge_vectors;
  modal_ = weighted_gram(root.transpose(), 2 * modal_damping_ratio / spectrum.frequency_rad_s);
  full_.emplace(modal_ + MatrixXd(edge_.matrix().asDiagonal()));
  MatrixXd flexibility = full_->inverse();
  ArrayXd compliance = node_.inverse();
  if (reduced.held) compliance[*reduced.held] = 0;
  MatrixXd incidence = MatrixXd::Zero(m, reduced.n_nodes());
  for (Index e = 0; e < m; ++e)
    incidence(e, reduced.edges[e].first) = 1, incidence(e, reduced.edges[e].second) = -1;
  flexibility += weighted_gram(incidence.transpose(), compliance);
  flexibility_.emplace(flexibility);
}

ArrayXd Stepper::leaving(const ArrayXd& edge_torque) const {
  ArrayXd sums = ArrayXd::Zero(reduced_.n_nodes());
  for (Index e = 0; e < reduced_.n_edges(); ++e) {
    sums[reduced_.edges[e].first] += edge_torque[e];
    sums[reduced_.edges[e].second] -= edge_torque[e];
  }
  return sums;
}

ArrayXd Stepper::modal(const ArrayXd& rate) const {
  return modal_.size() == 0 ? ArrayXd(ArrayXd::Zero(rate.size())) : ArrayXd((modal_ * rate.matrix()).array());
}

Stepper::Midpoint Stepper::solve(const ArrayXd& load) const {
  if (tree_) {
    const auto solution = tree_->solve(load);
    return {solution.angle, solution.torque / edge_};
  }
  ArrayXd free = load / node_, across(reduced_.n_edges());
  if (reduced_.held) free[*reduced_.held] = 0;
  for (Index e = 0; e < across.size(); ++e)
    across[e] = free[reduced_.edges[e].first] - free[reduced_.edges[e].second];
  const ArrayXd torque = flexibility_->solve(across.matrix()).array();
  ArrayXd speed = free - leaving(torque) / node_;
  if (reduced_.held) speed[*reduced_.held] = 0;
  return {speed, full_->solve(torque.matrix()).array()};
}

void Stepper::advance(const ArrayXd& load, StepState& state) const {
  const double dt = time_step_s_;
  const ArrayXd torque = reduced_.stiffness * state.twist + edge_ * state.rate + modal(state.rate);
  const auto change = solve(load - reduced_.damping * state.speed - leaving(torque));
  const Midpoint mid{state.speed + change.speed, state.rate + change.rate};
  state.work_J += dt * (load * mid.speed).sum();
  state.dissipated_J += dt * ((reduced_.damping * mid.speed.square()).sum() +
                              ((viscous_ * mid.rate + modal(mid.rate)) * mid.rate).sum());
  state.speed += 2 * change.speed;
  state.rate += 2 * change.rate;
  state.angle += dt * mid.speed;
  state.twist += dt * mid.rate;
}

ArrayXd Stepper::torque(const StepState& state) const {
  return reduced_.stiffness * state.twist + viscous_ * state.rate + modal(state.rate);
}

}  // namespace kinetics::torsion
