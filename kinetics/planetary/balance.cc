#include "kinetics/planetary/balance.h"

#include <algorithm>
#include <cmath>

#include "kinetics/planetary/checks.h"
#include "kinetics/values/constants.h"

namespace kinetics::planetary {
namespace {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index block_size = 256;

ArrayXd turned_rad(const TimeGrid& grid, Index first, Index count) {
  return ArrayXd::LinSpaced(count, double(first), double(first + count - 1)) *
         (2 * pi / grid.instants_per_turn);
}

LoadHistory empty_history(const Machine& machine, const std::vector<NamedEffect>& effects,
                          const TimeGrid& grid) {
  const Index n = Index(grid.turns) * grid.instants_per_turn;
  LoadHistory history;
  history.machine = "planetary_mill";
  history.convention = name_of(machine.mill.convention);
  for (const NamedEffect& effect : effects) history.effects.push_back(effect.name);
  const ArrayXd turned = turned_rad(grid, 0, n);
  history.time_s = turned / machine.mill.speed_rad_s;
  history.phi_rad = machine.mill.initial_angle_rad + turned;
  history.speed_rad_s = ArrayXd::Constant(n, machine.mill.speed_rad_s);
  history.acceleration_rad_s2 = ArrayXd::Zero(n);
  return history;
}

Array3Xd load_of(const Array2Xd& force_N, const ArrayXd& torque_Nm) {
  Array3Xd load(3, force_N.cols());
  load.topRows<2>() = force_N;
  load.row(2) = torque_Nm.transpose();
  return load;
}

enum RoleIndex { axle, trunnions, drum, inner_wall, pulley };

/// Roles in the order of RoleIndex.
std::vector<Resultant> open_roles(Index n) {
  const Array3Xd none = Array3Xd::Zero(3, n);
  return {{"axle", "load on the axle, (X_A, -Y_A) through A, carrier frame", none, {}},
          {"trunnions",
           "reaction of the carrier's bearings on the drum, (-X_A, Y_A) through A, carrier frame",
           none,
           {}},
          {"drum", "volume load of shell, covers and pulley through A, carrier frame", none, {}},
          {"inner_wall",
           "load of the charge on the drum's wall, through A with its torque, carrier frame",
           none,
           {}},
          {"pulley",
           "pull of the belt on the drum's pulley, through A with its torque, carrier frame; with "
           "the belt off the external drive couple",
           none,
           {}}};
}

/// Adds a block's load to an effect's contribution, made at its first mention, and to the total.
void post(Resultant& resultant, std::size_t effect, Index first, const Array3Xd& load) {
  auto& parts = resultant.contributions;
  auto part =
      std::find_if(parts.begin(), parts.end(), [&](const Contribution& c) { return c.effect == effect; });
  if (part == parts.end()) part = parts.insert(part, {effect, Array3Xd::Zero(3, resultant.total.cols())});
  part->load.middleCols(first, load.cols()) += load;
  resultant.total.middleCols(first, load.cols()) += load;
}

RoleIndex role_of(Receiver receiver) {
  if (receiver == Receiver::drum) return drum;
  return receiver == Receiver::inner_wall ? inner_wall : pulley;
}

}  // namespace

LoadHistory balance(const Machine& machine, const std::vector<NamedEffect>& effects, const TimeGrid& grid) {
  LoadHistory history = empty_history(machine, effects, grid);
  const Index n = history.n_instants();
  std::vector<Resultant> roles = open_roles(n);
  ArrayXd moment_Nm = ArrayXd::Zero(n);
  for (Index first = 0; first < n; first += block_size) {
    const Index count = std::min(block_size, n - first);
    Instants at{history.phi_rad.segment(first, count), ArrayXd::Zero(count)};
    const ArrayXd no_torque = ArrayXd::Zero(count);
    for (std::size_t e = 0; e < effects.size(); ++e) {
      const EffectLoad load = effects[e].evaluate(at);
      post(roles[axle], e, first, load_of(load.on_axle_N, no_torque));
      post(roles[trunnions], e, first, load_of(-load.on_axle_N, no_torque));
      post(roles[role_of(load.receiver)], e, first, load_of(load.force_N, load.moment_Nm));
      if (load.receiver != Receiver::pulley) at.moment_Nm += load.moment_Nm;
    }
    moment_Nm.segment(first, count) = at.moment_Nm;
  }
  if (!contains(history.effects, "belt") && !roles[inner_wall].contributions.empty()) {
    post(roles[pulley], effects.size(), 0, load_of(Array2Xd::Zero(2, n), -moment_Nm));
    history.effects.push_back("drive_couple");
  }
  for (const Resultant& role : roles)
    if (role.role == "axle" || role.role == "trunnions" || !role.contributions.empty())
      history.resultants.push_back(role);
  write_results(machine, moment_Nm, history);
  return history;
}

}  // namespace kinetics::planetary
