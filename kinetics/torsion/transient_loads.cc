#include <algorithm>
#include <cmath>

#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion_chain/checks.h"
#include "kinetics/torsion_chain/effects.h"
#include "kinetics/torsion_chain/excitation.h"
#include "kinetics/torsion_chain/load_parts.h"
#include "kinetics/torsion_chain/reduced.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using torsion::LoadPart;

/// The run without its torques and initial values.
TransientRun at_rest(const TransientRun& run) {
  TransientRun rest = run;
  rest.with_excitations = false;
  rest.loads.clear();
  rest.angle_rad = rest.speed_rad_s = ArrayXd();
  return rest;
}

LoadPart of_excitation(const DriveTrain& train, const TrainExcitation& excitation, const TransientRun& run) {
  DriveTrain alone = train;
  alone.excitations = {excitation};
  TransientRun own = at_rest(run);
  own.with_excitations = true;
  LoadPart part{excitation.name,
                torsion::inertia_at(alone, excitation.inertia, excitation.name + ".inertia"),
                transient(alone, own).motion,
                {}};
  const auto spectral = torsion::spectral(alone, torsion::reduce(alone));
  part.torque_Nm = part.motion.time_s;
  for (double& value : part.torque_Nm) value = torsion::torque_at(spectral, value)[*part.inertia];
  return part;
}

/// All loads of the run on one inertia.
LoadPart of_loads(const DriveTrain& train, const std::string& inertia, const TransientRun& run) {
  TransientRun own = at_rest(run);
  std::copy_if(run.loads.begin(), run.loads.end(), std::back_inserter(own.loads),
               [&](const TransientLoad& load) { return load.inertia == inertia; });
  LoadPart part{transient_torque_effect(inertia),
                torsion::inertia_at(train, inertia, "inertia of a transient load"),
                transient(train, own).motion,
                {}};
  part.torque_Nm = ArrayXd::Zero(part.motion.time_s.size());
  for (const TransientLoad& load : own.loads)
    for (Index t = 0; t < part.torque_Nm.size(); ++t)
      part.torque_Nm[t] += load.torque_Nm(part.motion.time_s[t]);
  return part;
}

std::vector<LoadPart> transient_parts(const DriveTrain& train, const TransientRun& run) {
  std::vector<LoadPart> parts;
  if (run.with_excitations)
    for (const TrainExcitation& excitation : train.excitations)
      parts.push_back(of_excitation(train, excitation, run));
  std::vector<std::string> loaded;
  for (const TransientLoad& load : run.loads)
    if (std::find(loaded.begin(), loaded.end(), load.inertia) == loaded.end()) loaded.push_back(load.inertia);
  for (const auto& inertia : loaded) parts.push_back(of_loads(train, inertia, run));
  if (run.angle_rad.size() > 0 || run.speed_rad_s.size() > 0 || parts.empty()) {
    TransientRun own = at_rest(run);
    own.angle_rad = run.angle_rad;
    own.speed_rad_s = run.speed_rad_s;
    parts.push_back({initial_motion_effect, std::nullopt, transient(train, own).motion, {}});
  }
  return parts;
}

TrainMotion sum_of(const std::vector<LoadPart>& parts) {
  TrainMotion sum = parts.front().motion;
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const TrainMotion& part = parts[p].motion;
    sum.angle_rad += part.angle_rad;
    sum.speed_rad_s += part.speed_rad_s;
    sum.acceleration_rad_s2 += part.acceleration_rad_s2;
    sum.torque_Nm += part.torque_Nm;
    sum.reduced_torque_Nm += part.reduced_torque_Nm;
  }
  return sum;
}

Index first_on_reference(const DriveTrain& train) {
  const auto found = std::find_if(train.inertias.begin(), train.inertias.end(),
                                  [&](const TrainInertia& i) { return i.shaft == train.reference_shaft; });
  return found - train.inertias.begin();
}

void warn_of_coarse_instants(const torsion::ReducedTrain& reduced, const TransientRun& run,
                             LoadHistory& history) {
  const ArrayXd natural = torsion::spectrum(reduced, false).frequency_rad_s;
  if (natural.size() == 0) return;
  const double instants = 2 * pi / natural.minCoeff() / (run.time_step_s * double(run.store_every));
  if (instants < 12)
    history.warnings.push_back("the transient has " + number(std::round(10 * instants) / 10) +
                               " stored instants per period of the lowest elastic mode, its peaks fall "
                               "between them; take a shorter step, or store more of them");
}

}  // namespace

std::string transient_torque_effect(const std::string& inertia) {
  return "transient_torque_on_" + inertia;
}

LoadHistory compute_transient_loads(const DriveTrain& train, const std::vector<std::string>& effects,
                                    const TransientRun& run) {
  torsion::check_effects(train, effects);
  DriveTrain on = with_effects(train, effects);
  if (!run.with_excitations) on.excitations.clear();
  const auto parts = transient_parts(on, run);
  const torsion::ReducedTrain reduced = torsion::reduce(on);
  LoadHistory history;
  history.machine = "drive_train";
  history.convention = "consistent";
  for (const LoadPart& part : parts) history.effects.push_back(part.effect);
  on.excitations.clear();  // what is left are the kinds of damping
  for (const EffectInfo& info : drive_train_effects(on)) history.effects.push_back(info.name);

  TrainMotion sum = sum_of(parts);
  const Index reference = first_on_reference(on);
  history.time_s = sum.time_s;
  history.phi_rad = sum.angle_rad.row(reference).transpose();
  history.speed_rad_s = sum.speed_rad_s.row(reference).transpose();
  history.acceleration_rad_s2 = sum.acceleration_rad_s2.row(reference).transpose();
  const Eigen::RowVectorXd uniform_rad = train.reference_speed_rad_s * sum.time_s.matrix().transpose();
  sum.angle_rad -= (reduced.ratio.matrix() * uniform_rad).array();
  torsion::write_parts(on, sum, parts, "angle on its own shaft, beside uniform running at its mean speed",
                       history);
  torsion::write_closure(on, history);
  warn_of_coarse_instants(reduced, run, history);
  return history;
}

}  // namespace kinetics
