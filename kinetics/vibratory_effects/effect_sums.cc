#include "kinetics/vibratory_effects/effect_sums.h"

#include <cmath>

namespace kinetics::vibratory {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

BodySums::BodySums(Index n)
    : force_N(Array2Xd::Zero(2, n)),
      force_scale_N(ArrayXd::Zero(n)),
      moment_Nm(ArrayXd::Zero(n)),
      moment_scale_Nm(ArrayXd::Zero(n)) {}

void BodySums::add(Index first, const Array2Xd& arm_m, const Array2Xd& force) {
  const Index count = force.cols();
  force_N.middleCols(first, count) += force;
  double* scale_N = force_scale_N.data() + first;
  double* sum_Nm = moment_Nm.data() + first;
  double* scale_Nm = moment_scale_Nm.data() + first;
  for (Index i = 0; i < count; ++i) {
    const double fx = force(0, i), fy = force(1, i);
    const double counter_clockwise = arm_m(0, i) * fy, clockwise = arm_m(1, i) * fx;
    scale_N[i] += std::sqrt(fx * fx + fy * fy);
    sum_Nm[i] += counter_clockwise - clockwise;
    scale_Nm[i] += std::abs(counter_clockwise) + std::abs(clockwise);
  }
}

void BodySums::add_couple(Index first, const ArrayXd& couple_Nm) {
  moment_Nm.segment(first, couple_Nm.size()) += couple_Nm;
  moment_scale_Nm.segment(first, couple_Nm.size()) += couple_Nm.abs();
}

EffectSums::EffectSums(const VibratoryMill& mill, std::size_t n_effects, const Instants& instants)
    : motion(instants),
      chamber(instants.size()),
      shaft(instants.size()),
      charge_power_W(ArrayXd::Zero(instants.size())),
      damping_power_W(charge_power_W),
      couple_Nm(charge_power_W) {
  const auto open = [&](const std::string& name, const std::string& description) {
    roles.push_back({name, description, Array3Xd::Zero(3, instants.size()), std::vector<Share>(n_effects)});
  };
  open("eccentric", "force -B of the chamber on the shaft, through E' = ecc e(phi)");
  open("debalance", "force on the debalances, at KE e(phi) of the shaft; torque: its moment about E");
  open("frame_bearings", "reaction R_E of the frame's bearings on the shaft, through E (massless shaft)");
  open("drive", "torque -T of the coupling on the shaft");
  open("housing_bore", "force B of the eccentric on the chamber, through E'");
  open("inner_wall",
       "force F_w of the charge on the chamber's wall, through its axis C; torque r e(chi) x F_w");
  for (std::size_t i = 0; i < mill.springs.size(); ++i)
    open("spring_foot_" + std::to_string(i + 1), "force of the spring on the chamber at its foot");
}

Columns EffectSums::to_fill(std::size_t role, std::size_t effect, Index first, Index count) {
  Share& share = roles[role].shares[effect];
  if (share.load.size() == 0) share.load.resize(3, motion.size());
  if (share.n_filled < first) share.load.middleCols(share.n_filled, first - share.n_filled).setZero();
  share.n_filled = first + count;
  return share.load.middleCols(first, count);
}

Columns EffectSums::to_add(std::size_t role, std::size_t effect, Index first, Index count) {
  const bool filled = roles[role].shares[effect].n_filled > first;
  Columns columns = to_fill(role, effect, first, count);
  if (!filled) columns.setZero();
  return columns;
}

std::vector<Resultant> EffectSums::take_resultants() {
  std::vector<Resultant> resultants;
  for (std::size_t index = 0; index < roles.size(); ++index) {
    Role& role = roles[index];
    Resultant resultant{role.name, role.description, std::move(role.total), {}};
    for (std::size_t effect = 0; effect < role.shares.size(); ++effect)
      if (Share& share = role.shares[effect]; share.load.size() > 0) {
        share.load.rightCols(motion.size() - share.n_filled).setZero();
        resultant.contributions.push_back({effect, std::move(share.load)});
      }
    const bool own_load = index == debalance || index >= inner_wall;
    if (!own_load || !resultant.contributions.empty()) resultants.push_back(std::move(resultant));
  }
  return resultants;
}

}  // namespace kinetics::vibratory
