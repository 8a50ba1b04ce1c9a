#include "kinetics/free_body.h"

#include <algorithm>

#include "kinetics/values/machine_refused.h"
#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory_effects/effect.h"
#include "kinetics/vibratory_effects/motion.h"
#include "kinetics/vibratory_mill.h"

namespace kinetics {
namespace {

using vibratory::Place;

/// What a person calls the force of an effect at a place.
std::string cause_of(const std::string& effect, const vibratory::PlacedForce& placed) {
  const bool is_weight = effect.rfind("gravity_", 0) == 0;
  switch (placed.place) {
    case Place::spring_foot:
      return "spring " + std::to_string(placed.foot + 1);
    case Place::structure_centre:
      return is_weight ? "weight of structure" : "inertia of structure";
    case Place::pivot:
      return is_weight ? "weight of exciter" : "inertia of exciter";
    case Place::charge_centre:
      return is_weight ? "weight of charge" : "inertia of charge";
    case Place::chamber_centre:
      return "inertia of charge in pitch";
    case Place::debalance:
      break;
  }
  return "debalance";
}

void add(const std::string& name, const Eigen::Array2Xd& at_m, const vibratory::PlacedForce& placed,
         std::vector<FreeBodyLoad>& loads) {
  auto load = std::find_if(loads.begin(), loads.end(), [&](const auto& l) { return l.name == name; });
  if (load == loads.end()) {
    const auto n = placed.force_N.cols();
    load = loads.insert(loads.end(), {name, at_m, Eigen::Array2Xd::Zero(2, n), Eigen::ArrayXd::Zero(n)});
  }
  load->force_N += placed.force_N;
  if (placed.couple_Nm.size() > 0) load->couple_N_m += placed.couple_Nm;
}

}  // namespace

Eigen::Array2Xd FreeBody::force_sum_N() const {
  Eigen::Array2Xd sum = Eigen::Array2Xd::Zero(2, time_s.size());
  for (const auto& load : loads) sum += load.force_N;
  return sum;
}

Eigen::ArrayXd FreeBody::moment_sum_N_m() const {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(time_s.size());
  for (const auto& load : loads)
    sum += (load.at_m.row(0) * load.force_N.row(1) - load.at_m.row(1) * load.force_N.row(0)).transpose() +
           load.couple_N_m;
  return sum;
}

FreeBody chamber_free_body(const VibratoryMill& mill, const std::vector<std::string>& effects,
                           const TimeGrid& grid) {
  if (mill.convention == Convention::published)
    throw MachineRefused("convention = published: its forces do not close; take the consistent convention");
  const auto history = compute_loads(mill, effects, grid);
  const auto made = vibratory::make_effects(mill, effects);
  auto motion = vibratory::steady_instants(mill, grid, 0, history.n_instants());
  if (vibratory::contains(made, "pitch")) vibratory::solve_pitch(mill, made).apply(motion);
  FreeBody body;
  body.time_s = history.time_s;
  body.phi_rad = history.phi_rad;
  body.pivot_m = mill.eccentricity_m * motion.along_phi;
  const auto n = history.n_instants();
  FreeBodyLoad bearing{"bearing", Eigen::Array2Xd::Zero(2, n), Eigen::Array2Xd(2, n),
                       Eigen::ArrayXd::Zero(n)};
  bearing.force_N.row(0) = history.quantity("B_x").values.transpose();
  bearing.force_N.row(1) = history.quantity("B_y").values.transpose();
  body.loads.push_back(std::move(bearing));
  for (const auto& effect : made)
    for (const auto& placed : effect.evaluate(motion))
      if (placed.place != Place::debalance)
        add(cause_of(effect.name, placed), vibratory::position(mill, placed, motion), placed, body.loads);
  return body;
}

}  // namespace kinetics
