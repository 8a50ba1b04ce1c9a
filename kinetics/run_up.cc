#include "kinetics/run_up.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory/balance.h"
#include "kinetics/vibratory/checks.h"
#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory/pitch_transient.h"
#include "kinetics/vibratory_effects/drive_motion.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using vibratory::DriveSegment;
using vibratory::Instants;
using vibratory::NamedEffect;
using vibratory::PitchOscillator;
using vibratory::PitchTransient;

void check_run(const VibratoryMill& mill, const RunUp& run) {
  if (mill.convention == Convention::published)
    throw MachineRefused(
        "convention \"published\": knows steady running only; choose the convention \"consistent\"");
  if (run.time_s.size() < 2)
    refuse("number of run.time_s", double(run.time_s.size()),
           "must be at least 2: where the run starts and ends");
  if (run.speed_rad_s.size() != run.time_s.size())
    refuse("number of run.speed_rad_s", double(run.speed_rad_s.size()),
           "must be that of run.time_s, " + number(double(run.time_s.size())));
  for (std::size_t i = 0; i < run.time_s.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    require_finite("run.time_s" + index, run.time_s[i]);
    require_finite("run.speed_rad_s" + index, run.speed_rad_s[i]);
    if (i > 0 && run.time_s[i] <= run.time_s[i - 1])
      refuse("run.time_s" + index, run.time_s[i], "must be later than the entry before it");
    if (run.speed_rad_s[i] < 0)
      refuse("run.speed_rad_s" + index, run.speed_rad_s[i],
             "must not be negative: the drive does not reverse");
  }
  require_finite("run.step_s", run.step_s);
  if (run.step_s < 0) refuse("run.step_s", run.step_s, "must be positive, or zero for the default");
  if (run.steps_per_instant < 1) refuse("run.steps_per_instant", run.steps_per_instant, "must be at least 1");
  if (run.start) {
    require_finite("run.start.theta_rad", run.start->theta_rad);
    require_finite("run.start.theta_rad_s", run.start->theta_rad_s);
  }
}

double step_s(const VibratoryMill& mill, const RunUp& run, const PitchOscillator& chamber) {
  if (run.step_s > 0) return run.step_s;
  const double fastest = *std::max_element(run.speed_rad_s.begin(), run.speed_rad_s.end());
  const double charge = std::abs(vibratory::charge_speed_ratio(mill));
  const double natural =
      chamber.inertia_kg_m2 > 0 ? std::sqrt(chamber.stiffness_Nm / chamber.inertia_kg_m2) : 0;
  const double highest_rad_s = std::max({2 * fastest, 2 * charge * fastest, natural});
  const double whole_s = run.time_s.back() - run.time_s.front();
  return highest_rad_s > 0 ? std::min(2 * pi / highest_rad_s / 200, whole_s) : whole_s / 200;
}

/// Pitch before the run: steady at its first speed, or hanging in its springs.
PitchState state_before(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const RunUp& run,
                        const PitchOscillator& chamber) {
  if (run.start) return *run.start;
  const ArrayXd phi = ArrayXd::Constant(1, mill.initial_angle_rad);
  const ArrayXd speed = ArrayXd::Constant(1, run.speed_rad_s.front());
  Instants at = vibratory::driven_at(mill, phi, speed, ArrayXd::Zero(1));
  if (speed[0] > 0) {
    VibratoryMill first = mill;
    first.speed_rad_s = speed[0];
    first.charge_relative_speed_rad_s = at.relative_speed_rad_s[0];
    vibratory::solve_pitch(first, effects).apply(at);
    return {at.theta_rad[0], at.theta_rad_s[0]};
  }
  const auto moment = vibratory::chamber_moment(mill, effects, at);
  if (std::abs(moment.moment_Nm[0]) <= 1e-13 * moment.scale_Nm[0]) return {};
  vibratory::require_support(chamber, moment.moment_Nm[0]);
  return {moment.moment_Nm[0] / chamber.stiffness_Nm, 0};
}

/// What the run leaves: motion with pitch at the history's instants, and the pitch's energy.
struct Course {
  ArrayXd time_s;
  Instants motion;
  ArrayXd energy_J, work_J, dissipation_J;
};

void append(ArrayXd& all, const ArrayXd& more) {
  ArrayXd joined(all.size() + more.size());
  joined << all, more;
  all = std::move(joined);
}

/// Moment at theta = 0 over any number of instants, by blocks.
ArrayXd moment_Nm(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at) {
  constexpr Index block_size = 256;
  ArrayXd moment(at.size());
  for (Index first = 0; first < at.size(); first += block_size) {
    const Index count = std::min(block_size, at.size() - first);
    moment.segment(first, count) =
        vibratory::chamber_moment(mill, effects, vibratory::part_of(at, first, count)).moment_Nm;
  }
  return moment;
}

Course follow(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const RunUp& run) {
  const bool pitching = vibratory::contains(effects, "pitch");
  const PitchOscillator chamber = pitching ? vibratory::pitch_oscillator(mill, effects) : PitchOscillator{};
  PitchState state = pitching ? state_before(mill, effects, run, chamber) : PitchState{};
  double work_J = 0, dissipation_J = 0;
  Course course;
  const auto segments = vibratory::drive_segments(mill, run, step_s(mill, run, chamber));
  for (const DriveSegment& segment : segments) {
    const Index n = segment.n_steps, every = run.steps_per_instant;
    Instants at = vibratory::segment_instants(mill, segment, 0, n + 1);
    PitchTransient pitch(n + 1);
    if (pitching)
      pitch = integrate_pitch(chamber, moment_Nm(mill, effects, at), segment.step_s(), state, work_J,
                              dissipation_J);
    at.theta_rad = pitch.theta_rad, at.theta_rad_s = pitch.theta_rad_s, at.theta_rad_s2 = pitch.theta_rad_s2;
    state = {pitch.theta_rad[n], pitch.theta_rad_s[n]};
    work_J = pitch.work_J[n], dissipation_J = pitch.dissipation_J[n];

    // The segment's end is the next one's beginning, with the acceleration from there on.
    const Index count = n / every + (&segment == &segments.back() ? 1 : 0);
    const auto kept = Eigen::seqN(Index(0), count, every);
    vibratory::append(course.motion, vibratory::every_nth(at, every, count));
    append(course.time_s, segment.times_s()(kept));
    append(course.energy_J, pitch.energy_J(kept));
    append(course.work_J, pitch.work_J(kept));
    append(course.dissipation_J, pitch.dissipation_J(kept));
  }
  return course;
}

}  // namespace

RunUp ramp(double from_rad_s, double to_rad_s, double duration_s, double hold_s) {
  RunUp run;
  run.time_s = {0, duration_s};
  run.speed_rad_s = {from_rad_s, to_rad_s};
  if (hold_s != 0) {
    run.time_s.push_back(duration_s + hold_s);
    run.speed_rad_s.push_back(to_rad_s);
  }
  return run;
}

void check_run_up(const VibratoryMill& mill, const std::vector<std::string>& effects, const RunUp& run) {
  vibratory::check_effects(mill.convention, effects);
  vibratory::check_parameters(mill, effects);
  check_run(mill, run);
}

LoadHistory compute_run_up(const VibratoryMill& mill, const std::vector<std::string>& effects,
                           const RunUp& run) {
  check_run_up(mill, effects, run);
  const auto made = vibratory::make_effects(mill, effects);
  const Course course = follow(mill, made, run);
  LoadHistory history = vibratory::empty_history(mill, made, course.time_s, course.motion);
  vibratory::balance_over(mill, made, course.motion, history);
  if (!vibratory::contains(effects, "pitch")) return history;
  auto& q = history.quantities;
  q.push_back({"pitch_energy", "J", "I theta'^2 / 2 + k_theta theta^2 / 2", course.energy_J});
  q.push_back({"pitch_work", "J", "work of the moments on the pitch since the start", course.work_J});
  q.push_back({"pitch_dissipation", "J", "what damping has taken from the pitch since the start",
               course.dissipation_J});
  q.push_back({"pitch_energy_residual", "J", "pitch_energy - its start - pitch_work + pitch_dissipation",
               course.energy_J - course.energy_J[0] - course.work_J + course.dissipation_J});
  return history;
}

}  // namespace kinetics
