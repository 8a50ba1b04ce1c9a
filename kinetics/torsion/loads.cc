#include <algorithm>
#include <cmath>

#include "kinetics/constants.h"
#include "kinetics/torsion/checks.h"
#include "kinetics/torsion/effects.h"
#include "kinetics/torsion/forced.h"
#include "kinetics/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

/// One excitation and the motion that it brings alone.
struct Part {
  std::string effect;
  Index inertia = 0;
  TrainMotion motion;
  ArrayXd torque_Nm;  ///< of the excitation itself
};

/// A resultant that is a torque alone.
template <class TorqueOf>
Resultant torque_on(const std::string& role, const std::string& description, const std::vector<Part>& parts,
                    Index n, const TorqueOf& torque_of) {
  Resultant resultant{role, description, Array3Xd::Zero(3, n), {}};
  for (const Part& part : parts) {
    Array3Xd load = Array3Xd::Zero(3, n);
    load.row(2) = torque_of(part).transpose();
    resultant.total += load;
    resultant.contributions.push_back({part.effect, load});
  }
  return resultant;
}

std::vector<Part> parts_of(const torsion::PreparedTrain& prepared, const ArrayXd& time_s) {
  std::vector<Part> parts;
  for (const TrainExcitation& x : prepared.train.excitations) {
    DriveTrain alone = prepared.train;
    alone.excitations = {x};
    const auto excitation = torsion::spectral(alone, prepared.reduced);
    Part part{x.name, torsion::inertia_at(alone, x.inertia, x.name + ".inertia"),
              over_time(alone, torsion::respond(prepared, excitation), time_s), ArrayXd(time_s.size())};
    for (Index t = 0; t < time_s.size(); ++t)
      part.torque_Nm[t] = torsion::torque_at(excitation, time_s[t])[part.inertia];
    parts.push_back(std::move(part));
  }
  return parts;
}

void write_inertia(const torsion::PreparedTrain& p, Index i, const TrainMotion& sum,
                   const std::vector<Part>& parts, LoadHistory& history) {
  const TrainInertia& inertia = p.train.inertias[i];
  const Index n = sum.time_s.size();
  history.quantities.push_back({inertia.name + ".angle", "rad",
                                "angle on its own shaft, beside uniform running and rigid acceleration",
                                sum.angle_rad.row(i).transpose()});
  history.quantities.push_back(
      {inertia.name + ".acceleration", "rad/s2", "phi'' in (9)", sum.acceleration_rad_s2.row(i).transpose()});
  std::vector<Part> own;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(own),
               [&](const Part& x) { return x.inertia == i; });
  if (!own.empty())
    history.resultants.push_back(torque_on("excitation_on_" + inertia.name, "excitations on " + inertia.name,
                                           own, n, [](const Part& part) { return part.torque_Nm; }));
  if (inertia.damping_N_m_s != 0)
    history.resultants.push_back(
        torque_on("damping_on_" + inertia.name, "drag of the ground on " + inertia.name + ", -D phi'", parts,
                  n, [&](const Part& part) -> ArrayXd {
                    return -inertia.damping_N_m_s * part.motion.speed_rad_s.row(i).transpose();
                  }));
}

void write_element(const torsion::PreparedTrain& p, Index e, const TrainMotion& sum,
                   const std::vector<Part>& parts, LoadHistory& history) {
  const TrainElement& element = p.train.elements[e];
  const ArrayXd torque_Nm = sum.torque_Nm.row(e).transpose();
  const Index n = sum.time_s.size();
  history.quantities.push_back(
      {element.name + ".torque", "N m",
       "torque from " + element.first + " to " + element.second + ", on the shaft of " + element.first,
       torque_Nm});
  history.quantities.push_back({element.name + ".reduced_torque", "N m",
                                "the same, reduced to the reference shaft (7)",
                                sum.reduced_torque_Nm.row(e).transpose()});
  if (element.diameter_m > 0) {
    const double I_p_m4 = pi / 32 * (std::pow(element.diameter_m, 4) - std::pow(element.bore_m, 4));
    history.quantities.push_back(
        {element.name + ".shear_stress", "Pa", "K_t T r / I_p at the surface, the sign of the torque",
         element.stress_concentration * torque_Nm * (element.diameter_m / 2 / I_p_m4)});
  }
  const auto on_first = [&](const Part& part) -> ArrayXd {
    return -part.motion.torque_Nm.row(e).transpose();
  };
  const auto on_second = [&](const Part& part) -> ArrayXd {
    return part.motion.torque_Nm.row(e).transpose() / element.ratio;
  };
  for (const auto& [inertia, first] : {std::pair{element.first, true}, std::pair{element.second, false}}) {
    const std::string role = element.name + "_on_" + inertia,
                      text = "torque of " + element.name + " on " + inertia;
    history.resultants.push_back(first ? torque_on(role, text, parts, n, on_first)
                                       : torque_on(role, text, parts, n, on_second));
  }
}

/// |sum of torques - J phi''| over the sum of sizes, the worst inertia at each instant; a held one has a
/// reaction.
ArrayXd closure(const DriveTrain& train, const LoadHistory& history) {
  ArrayXd worst = ArrayXd::Zero(history.time_s.size());
  for (const TrainInertia& inertia : train.inertias) {
    if (inertia.held) continue;
    ArrayXd sum = -inertia.inertia_kg_m2 * history.quantity(inertia.name + ".acceleration").values;
    ArrayXd size = sum.abs();
    const auto add = [&](const std::string& role) {
      if (!history.has_resultant(role)) return;
      const ArrayXd torque_Nm = history.resultant(role).total.row(2).transpose();
      sum += torque_Nm, size += torque_Nm.abs();
    };
    add("excitation_on_" + inertia.name);
    add("damping_on_" + inertia.name);
    for (const TrainElement& e : train.elements)
      if (e.first == inertia.name || e.second == inertia.name) add(e.name + "_on_" + inertia.name);
    const double scale = size.maxCoeff();
    if (scale > 0) worst = worst.max(sum.abs() / scale);
  }
  return worst;
}

void write_warnings(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid,
                    LoadHistory& history) {
  const double turn_s = 2 * pi / p.train.reference_speed_rad_s, window_s = grid.turns * turn_s;
  if (!all.harmonics.empty()) {
    const double repeats = all.period_s ? window_s / *all.period_s : 0;
    if (!all.period_s || std::abs(repeats - std::round(repeats)) > 1e-9 * repeats || repeats < 0.5)
      history.warnings.push_back("the history covers " + number(window_s) + " s, the vibration repeats " +
                                 (all.period_s
                                      ? "after " + number(*all.period_s) + " s"
                                      : std::string("never: its frequencies have no common period")) +
                                 "; extremes and means are those of the window");
    const double samples = 2 * pi / all.harmonics.back().frequency_rad_s / (turn_s / grid.instants_per_turn);
    if (samples < 4)
      history.warnings.push_back(
          "the fastest harmonic has " + number(std::round(10 * samples) / 10) +
          " instants per period, its peaks fall between them; take more instants per turn");
  }
  if (all.rigid_acceleration_rad_s2 != 0)
    history.warnings.push_back(
        "the constant torques do not balance: they accelerate the reference shaft by " +
        number(all.rigid_acceleration_rad_s2) + " rad/s2");
}

}  // namespace

LoadHistory compute_loads(const DriveTrain& train, const std::vector<std::string>& effects,
                          const TimeGrid& grid) {
  torsion::check_effects(train, effects);
  check_grid(grid);
  const torsion::PreparedTrain prepared(with_effects(train, effects));
  const auto excitation = torsion::spectral(prepared.train, prepared.reduced);
  LoadHistory history;
  history.machine = "drive_train";
  history.convention = "consistent";
  for (const EffectInfo& info : drive_train_effects(prepared.train)) history.effects.push_back(info.name);
  history.warnings = torsion::resonance_warnings(prepared, excitation.lines);
  const Index n = Index(grid.turns) * grid.instants_per_turn;
  history.phi_rad = 2 * pi / grid.instants_per_turn * ArrayXd::LinSpaced(n, 0, double(n - 1));
  history.time_s = history.phi_rad / train.reference_speed_rad_s;
  history.speed_rad_s = ArrayXd::Constant(n, train.reference_speed_rad_s);
  history.acceleration_rad_s2 = ArrayXd::Zero(n);

  const ForcedResponse all = torsion::respond(prepared, excitation);
  const TrainMotion sum = over_time(prepared.train, all, history.time_s);
  const std::vector<Part> parts = parts_of(prepared, history.time_s);
  for (Index i = 0; i < prepared.reduced.ratio.size(); ++i) write_inertia(prepared, i, sum, parts, history);
  for (Index e = 0; e < static_cast<Index>(train.elements.size()); ++e)
    write_element(prepared, e, sum, parts, history);
  history.quantities.push_back({"rigid_acceleration", "rad/s2",
                                "of the reference shaft, under constant torques that do not balance",
                                ArrayXd::Constant(n, all.rigid_acceleration_rad_s2)});
  history.quantities.push_back({"closure", "1",
                                "|sum of torques - J phi''| over their largest sum of sizes, worst inertia",
                                closure(train, history)});
  write_warnings(prepared, all, grid, history);
  return history;
}

}  // namespace kinetics
