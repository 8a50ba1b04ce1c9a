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

constexpr double instants_of_crests = 24;  // per period: they miss (pi / 24)^2 / 2, 0.9 % of a harmonic
constexpr double missed_worth_a_warning = 0.02;
constexpr double most_instants_of_crests = 100'000;

double instants_per_period(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid) {
  const double turn_s = 2 * pi / p.train.reference_speed_rad_s;
  return 2 * pi / all.harmonics.back().frequency_rad_s / (turn_s / grid.instants_per_turn);
}

/// Which element's largest torque over the window lies between the instants, and by how much; empty: of none
/// by more than a harmonic's crest is missed by instants_of_crests.
std::string torque_missed(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid,
                          const TrainMotion& at_instants) {
  const double samples = instants_per_period(p, all, grid), times = std::ceil(instants_of_crests / samples);
  const Index n = at_instants.time_s.size();
  if (times < 2 || times * double(n) > most_instants_of_crests) return "";
  const auto n_dense = Index(times) * n;
  const auto dense = over_time(
      p.train, all, ArrayXd::LinSpaced(n_dense, 0, double(n_dense - 1)) * (at_instants.time_s[1] / times));
  const double rounding = 1e-9 * dense.reduced_torque_Nm.abs().maxCoeff();
  std::string worst;
  double most = missed_worth_a_warning;
  for (Index e = 0; e < dense.torque_Nm.rows(); ++e) {
    const double largest = dense.torque_Nm.row(e).abs().maxCoeff();
    if (dense.reduced_torque_Nm.row(e).abs().maxCoeff() <= rounding) continue;
    const double missed = 1 - at_instants.torque_Nm.row(e).abs().maxCoeff() / largest;
    if (missed <= most) continue;
    most = missed;
    worst = p.train.elements[std::size_t(e)].name + " by " + number(std::round(1000 * missed) / 10) + " % (" +
            number(largest) + " N m)";
  }
  return worst;
}

void write_warnings(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid,
                    const TrainMotion& at_instants, LoadHistory& history) {
  const double turn_s = 2 * pi / p.train.reference_speed_rad_s, window_s = grid.turns * turn_s;
  if (!all.harmonics.empty()) {
    const double repeats = all.period_s ? window_s / *all.period_s : 0;
    if (!all.period_s || std::abs(repeats - std::round(repeats)) > 1e-9 * repeats || repeats < 0.5)
      history.warnings.push_back("the history covers " + number(window_s) + " s, the vibration repeats " +
                                 (all.period_s
                                      ? "after " + number(*all.period_s) + " s"
                                      : std::string("never: its frequencies have no common period")) +
                                 "; extremes and means are those of the window");
    const double samples = instants_per_period(p, all, grid);
    const auto missed = torque_missed(p, all, grid, at_instants);
    if (samples < 4 || !missed.empty())
      history.warnings.push_back("the fastest harmonic has " + number(std::round(10 * samples) / 10) +
                                 " instants per period, its peaks fall between them; " +
                                 (missed.empty() ? "" : "they miss the largest torque of " + missed + "; ") +
                                 "take more instants per turn");
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
  write_warnings(prepared, all, grid, sum, history);
  return history;
}

}  // namespace kinetics
