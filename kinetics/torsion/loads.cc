#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kinetics/series/course_figures.h"
#include "kinetics/torsion/forced.h"
#include "kinetics/torsion_chain/checks.h"
#include "kinetics/torsion_chain/effects.h"
#include "kinetics/torsion_chain/load_parts.h"
#include "kinetics/train_crests.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/wrong_input.h"

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
constexpr double most_work = 2e7;  // instants times harmonics, about two seconds

/// The sizes, raised to rounding of the largest where they are below it.
ArrayXd above_rounding(const ArrayXd& sizes) {
  constexpr double rounding = 1e-9;
  return sizes.max(std::max(1e-300, rounding * sizes.maxCoeff()));
}

/// The size of each element's torque at most, of its mean and all harmonics together.
ArrayXd whole_torque_Nm(const ForcedResponse& all) {
  ArrayXd whole = all.mean_torque_Nm.abs();
  for (const auto& line : all.harmonics) whole += line.torque_Nm.abs();
  return above_rounding(whole);
}

/// The same of each inertia's angle times a power of the frequency: 2 of its acceleration. Without means.
ArrayXd whole_motion(const ForcedResponse& all, int power) {
  ArrayXd whole = ArrayXd::Zero(all.mean_angle_rad.size());
  for (const auto& line : all.harmonics)
    whole += std::pow(line.frequency_rad_s, power) * line.angle_rad.abs();
  return above_rounding(whole);
}

enum class Of { torques, torques_and_motions };

/// The response without the many small harmonics of a table that together are less than 0.5 % of every
/// element's torque, and of every inertia's angle and acceleration where these matter.
ForcedResponse with_lines_that_count(const ForcedResponse& all, Of of = Of::torques) {
  constexpr double left_out = 0.005;
  const ArrayXd torques = whole_torque_Nm(all), angles = whole_motion(all, 0),
                accelerations = whole_motion(all, 2);
  std::vector<std::pair<double, std::size_t>> shares;
  for (std::size_t l = 0; l < all.harmonics.size(); ++l) {
    const auto& line = all.harmonics[l];
    double share = (line.torque_Nm.abs() / torques).maxCoeff();
    if (of == Of::torques_and_motions)
      share =
          std::max({share, (line.angle_rad.abs() / angles).maxCoeff(),
                    (std::pow(line.frequency_rad_s, 2) * line.angle_rad.abs() / accelerations).maxCoeff()});
    shares.emplace_back(share, l);
  }
  std::sort(shares.begin(), shares.end());
  std::vector<char> counts(shares.size(), 1);
  double sum = 0;
  for (const auto& [share, l] : shares) {
    sum += share;
    if (sum > left_out) break;
    counts[l] = 0;
  }
  ForcedResponse result = all;
  result.harmonics.clear();
  for (std::size_t l = 0; l < counts.size(); ++l)
    if (counts[l]) result.harmonics.push_back(all.harmonics[l]);
  return result;
}

double instants_per_period(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid) {
  const double turn_s = 2 * pi / p.train.reference_speed_rad_s;
  return 2 * pi / all.harmonics.back().frequency_rad_s / (turn_s / grid.instants_per_turn);
}

/// Which element's largest torque over the window lies between the instants, and by how much; empty: of none
/// by more than a harmonic's crest is missed by instants_of_crests.
std::string torque_missed(const torsion::PreparedTrain& p, const ForcedResponse& response,
                          const TimeGrid& grid, const ArrayXd& time_s) {
  const auto all = with_lines_that_count(response);
  if (all.harmonics.empty()) return "";
  const double times = std::ceil(instants_of_crests / instants_per_period(p, all, grid));
  const double n_dense = times * double(time_s.size());
  if (times < 2 || n_dense * double(all.harmonics.size()) > most_work) return "";
  const auto at_instants = over_time(p.train, all, time_s);
  const auto dense =
      over_time(p.train, all, ArrayXd::LinSpaced(Index(n_dense), 0, n_dense - 1) * (time_s[1] / times));
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
            rounded(largest) + " N m)";
  }
  return worst;
}

void write_warnings(const torsion::PreparedTrain& p, const ForcedResponse& all, const TimeGrid& grid,
                    LoadHistory& history) {
  const double turn_s = 2 * pi / p.train.reference_speed_rad_s, window_s = grid.turns * turn_s;
  if (!all.harmonics.empty()) {
    const double repeats = all.period_s ? window_s / *all.period_s : 0;
    if (!all.period_s || std::abs(repeats - std::round(repeats)) > 1e-9 * repeats || repeats < 0.5)
      history.warnings.push_back("the history covers " + rounded(window_s, 6) + " s, the vibration repeats " +
                                 (all.period_s
                                      ? "after " + rounded(*all.period_s, 6) + " s"
                                      : std::string("never: its frequencies have no common period")) +
                                 "; extremes and means are those of the window");
    const double samples = instants_per_period(p, all, grid);
    const auto missed = torque_missed(p, all, grid, history.time_s);
    if (samples < 4 || !missed.empty())
      history.warnings.push_back("the fastest harmonic has " + number(std::round(10 * samples) / 10) +
                                 " instants per period, its peaks fall between them; " +
                                 (missed.empty() ? ""
                                                 : "they miss the largest torque of " + missed +
                                                       ", which extremes of torques have and single instants "
                                                       "have not; ") +
                                 "take more instants per turn");
  }
}

ArrayXd instants_of(const TimeGrid& grid) {
  const Index n = Index(grid.turns) * grid.instants_per_turn;
  return 2 * pi / grid.instants_per_turn * ArrayXd::LinSpaced(n, 0, double(n - 1));
}

/// A train under its effects in its steady state.
/// @throws MachineRefused for a line at a natural frequency that nothing damps
struct SteadyTrain {
  /// @param is_known  compute_loads has not refused it: resonances are not looked for again
  SteadyTrain(const DriveTrain& train, const std::vector<std::string>& effects, bool is_known = false)
      : prepared(with_effects(train, effects)),
        excitation(torsion::spectral(prepared.train, prepared.reduced)),
        resonances(is_known ? std::vector<std::string>()
                            : torsion::resonance_warnings(prepared, excitation.lines)),
        all(torsion::respond(prepared, excitation)) {}

  TrainMotion motion_at(const ArrayXd& phi_rad) const {
    return over_time(prepared.train, all, phi_rad / prepared.train.reference_speed_rad_s);
  }

  torsion::PreparedTrain prepared;
  torsion::Spectral excitation;
  std::vector<std::string> resonances;  ///< warnings
  ForcedResponse all;
};

/// The history at these angles of the reference shaft, without warnings.
LoadHistory history_at(const ArrayXd& phi_rad, const DriveTrain& train, const SteadyTrain& steady,
                       const TrainMotion& motion) {
  LoadHistory history;
  history.machine = "drive_train";
  history.convention = "consistent";
  for (const EffectInfo& info : drive_train_effects(steady.prepared.train))
    history.effects.push_back(info.name);
  const Index n = phi_rad.size();
  history.phi_rad = phi_rad;
  history.time_s = phi_rad / train.reference_speed_rad_s;
  history.speed_rad_s = ArrayXd::Constant(n, train.reference_speed_rad_s);
  history.acceleration_rad_s2 = ArrayXd::Zero(n);
  torsion::write_parts(steady.prepared.train, motion, parts_of(steady.prepared, history.time_s),
                       "angle on its own shaft, beside uniform running and rigid acceleration", history);
  history.quantities.push_back({"rigid_acceleration", "rad/s2",
                                "of the reference shaft, under constant torques that do not balance",
                                ArrayXd::Constant(n, steady.all.rigid_acceleration_rad_s2)});
  torsion::write_closure(train, history);
  return history;
}

/// What a quantity times a factor amounts to.
CourseFigures times_factor(const CourseFigures& of, double factor, const std::string& name) {
  const bool keeps = factor >= 0;
  return {name,
          factor * (keeps ? of.largest : of.least),
          factor * (keeps ? of.least : of.largest),
          factor * of.mean,
          std::abs(factor) * of.rms,
          keeps ? of.time_of_largest_s : of.time_of_least_s,
          keeps ? of.time_of_least_s : of.time_of_largest_s};
}

/// Torques of the elements on their inertias, of their own torques.
std::vector<CourseFigures> on_inertias(const DriveTrain& train, const std::vector<CourseFigures>& figures) {
  std::vector<CourseFigures> result;
  for (const auto& element : train.elements)
    for (const auto& of : figures)
      if (of.quantity == element.name + ".torque") {
        result.push_back(times_factor(of, -1, element.name + "_on_" + element.first + ".torque"));
        result.push_back(
            times_factor(of, 1 / element.ratio, element.name + "_on_" + element.second + ".torque"));
      }
  return result;
}

constexpr double counts = 1e-3;  // a harmonic counts from this share of an element's torque on

/// Whether harmonics count that have so many instants per period or fewer.
bool has_lines_with(double instants, const ForcedResponse& all, double sampling_rad_s) {
  ArrayXd untold = ArrayXd::Zero(all.mean_torque_Nm.size());
  for (const auto& line : all.harmonics)
    if (instants * line.frequency_rad_s >= sampling_rad_s * (1 - 1e-9)) untold += line.torque_Nm.abs();
  return (untold > counts * whole_torque_Nm(all)).any();
}

}  // namespace

LoadHistory compute_loads(const DriveTrain& train, const std::vector<std::string>& effects,
                          const TimeGrid& grid) {
  torsion::check_effects(train, effects);
  check_grid(grid);
  const SteadyTrain steady(train, effects);
  const ArrayXd phi_rad = instants_of(grid);
  const auto motion = steady.motion_at(phi_rad);
  auto history = history_at(phi_rad, train, steady, motion);
  history.warnings = steady.resonances;
  history.warnings.insert(history.warnings.end(), steady.all.warnings.begin(), steady.all.warnings.end());
  write_warnings(steady.prepared, steady.all, grid, history);
  return history;
}

std::optional<LoadHistory> loads_between_instants(const DriveTrain& train,
                                                  const std::vector<std::string>& effects,
                                                  const TimeGrid& grid, Index most) {
  torsion::check_effects(train, effects);
  check_grid(grid);
  const SteadyTrain steady(train, effects);
  const double sampling_rad_s = train.reference_speed_rad_s * grid.instants_per_turn;
  // By three a spectrum cannot tell that nothing is above; by two it lacks the line.
  if (!has_lines_with(3, steady.all, sampling_rad_s)) return std::nullopt;
  const auto all = with_lines_that_count(steady.all);
  if (all.harmonics.empty()) return std::nullopt;
  const auto motion_at = [&](const ArrayXd& phi_rad) {
    return over_time(steady.prepared.train, all, phi_rad / train.reference_speed_rad_s);
  };
  const double times = std::ceil(instants_of_crests * all.harmonics.back().frequency_rad_s / sampling_rad_s);
  const ArrayXd instants = instants_of(grid), whole = whole_torque_Nm(all);
  if (times * double(instants.size()) <= double(most)) {
    const ArrayXd phi_rad = instants_of({grid.turns, int(times) * grid.instants_per_turn});
    return history_at(phi_rad, train, steady, steady.motion_at(phi_rad));
  }
  if (!has_lines_with(2, steady.all, sampling_rad_s)) return std::nullopt;
  const ArrayXd known = motion_at(instants).torque_Nm.abs().rowwise().maxCoeff();
  constexpr Index at_once = 4096;
  const double step_rad = 2 * pi / grid.instants_per_turn / times;
  const auto n = Index(std::min(times * double(instants.size()),
                                std::max(double(at_once), most_work / double(all.harmonics.size()))));
  std::vector<std::pair<double, Index>> found;  // by how much, which
  for (Index first = 0; first < n; first += at_once) {
    const Index count = std::min(at_once, n - first);
    const auto motion =
        motion_at(ArrayXd::LinSpaced(count, double(first), double(first + count - 1)) * step_rad);
    for (Index i = 0; i < count; ++i) {
      const double excess = ((motion.torque_Nm.col(i).abs() - known) / whole).maxCoeff();
      if (excess > counts) found.emplace_back(excess, first + i);
    }
  }
  if (found.empty()) return std::nullopt;
  if (Index(found.size()) > most) {
    std::nth_element(found.begin(), found.begin() + most, found.end(), std::greater<>());
    found.resize(std::size_t(most));
  }
  ArrayXd phi_rad(Index(found.size()));
  for (Index i = 0; i < phi_rad.size(); ++i) phi_rad[i] = double(found[std::size_t(i)].second) * step_rad;
  std::sort(phi_rad.begin(), phi_rad.end());
  return history_at(phi_rad, train, steady, steady.motion_at(phi_rad));
}

std::vector<CourseFigures> figures_over_the_course(const DriveTrain& train,
                                                   const std::vector<std::string>& effects,
                                                   const TimeGrid& grid, const LoadHistory* at_instants) {
  torsion::check_effects(train, effects);
  check_grid(grid);
  const SteadyTrain steady(train, effects, at_instants != nullptr);
  if (steady.all.harmonics.empty()) return {};
  const auto n_with = [&](const ForcedResponse& lines) {
    return std::ceil(std::max(1.0, instants_of_crests / instants_per_period(steady.prepared, lines, grid))) *
           double(grid.turns) * grid.instants_per_turn;
  };
  const auto is_too_much = [](double n, const ForcedResponse& lines) {
    return n * double(lines.harmonics.size()) > most_work;
  };
  auto counting = with_lines_that_count(steady.all, Of::torques_and_motions);
  if (!counting.harmonics.empty() && is_too_much(n_with(counting), counting))
    counting = with_lines_that_count(steady.all, Of::torques);
  if (counting.harmonics.empty()) return {};
  const double n = n_with(counting), times = n / (double(grid.turns) * grid.instants_per_turn);
  if (is_too_much(n, counting)) return {};
  const auto& lines = is_too_much(n, steady.all) ? counting : steady.all;
  const double step_s = 2 * pi / grid.instants_per_turn / times / train.reference_speed_rad_s;
  const auto at = [&](const ArrayXd& time_s) {
    LoadHistory block;
    block.time_s = time_s;
    torsion::write_parts(steady.prepared.train, over_time(steady.prepared.train, lines, time_s), {}, "",
                         block);
    return block;
  };
  std::vector<CourseSums> sums;
  if (at_instants != nullptr && times == 1 && &lines == &steady.all &&
      double(at_instants->n_instants()) == n) {
    const auto around = at((ArrayXd(2) << -step_s, n * step_s).finished());
    ArrayXd time_s(Index(n) + 2), values(Index(n) + 2);
    time_s << around.time_s[0], at_instants->time_s, around.time_s[1];
    for (const auto& ends : around.quantities) {
      values << ends.values[0], at_instants->quantity(ends.name).values, ends.values[1];
      sums.emplace_back(ends.name).add(values, time_s);
    }
  } else {
    constexpr double at_once = 4096;
    for (double first = 0; first < n; first += at_once) {
      const double count = std::min(at_once, n - first);
      const auto block = at(ArrayXd::LinSpaced(Index(count) + 2, first - 1, first + count) * step_s);
      if (sums.empty())
        for (const auto& quantity : block.quantities) sums.emplace_back(quantity.name);
      for (std::size_t q = 0; q < sums.size(); ++q) sums[q].add(block.quantities[q].values, block.time_s);
    }
  }
  std::vector<CourseFigures> figures;
  for (const auto& sum : sums) figures.push_back(sum.figures());
  const auto more = on_inertias(steady.prepared.train, figures);
  figures.insert(figures.end(), more.begin(), more.end());
  return figures;
}

}  // namespace kinetics
