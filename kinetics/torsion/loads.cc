#include <algorithm>
#include <cmath>

#include "kinetics/constants.h"
#include "kinetics/torsion/checks.h"
#include "kinetics/torsion/effects.h"
#include "kinetics/torsion/forced.h"
#include "kinetics/torsion/load_parts.h"
#include "kinetics/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using torsion::LoadPart;

std::vector<LoadPart> parts_of(const torsion::PreparedTrain& prepared, const ArrayXd& time_s) {
  std::vector<LoadPart> parts;
  for (const TrainExcitation& x : prepared.train.excitations) {
    DriveTrain alone = prepared.train;
    alone.excitations = {x};
    const auto excitation = torsion::spectral(alone, prepared.reduced);
    LoadPart part{x.name, torsion::inertia_at(alone, x.inertia, x.name + ".inertia"),
                  over_time(alone, torsion::respond(prepared, excitation), time_s), ArrayXd(time_s.size())};
    for (Index t = 0; t < time_s.size(); ++t)
      part.torque_Nm[t] = torsion::torque_at(excitation, time_s[t])[*part.inertia];
    parts.push_back(std::move(part));
  }
  return parts;
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
  torsion::write_parts(prepared.train, sum, parts_of(prepared, history.time_s),
                       "angle on its own shaft, beside uniform running and rigid acceleration", history);
  history.quantities.push_back({"rigid_acceleration", "rad/s2",
                                "of the reference shaft, under constant torques that do not balance",
                                ArrayXd::Constant(n, all.rigid_acceleration_rad_s2)});
  torsion::write_closure(train, history);
  write_warnings(prepared, all, grid, history);
  return history;
}

}  // namespace kinetics
