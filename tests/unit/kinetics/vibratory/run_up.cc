#include "kinetics/run_up.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using kinetics::LoadHistory;
using kinetics::RunUp;
using kinetics::VibratoryMill;
using machines::effects_without;
using machines::largest;
using Names = std::vector<std::string>;

Names all_effects(const VibratoryMill& mill) {
  return effects_without(mill, {"charge_lag"});
}

VibratoryMill undamped() {
  auto mill = machines::laboratory();
  for (auto& spring : mill.springs) spring.damping_N_s_m.setZero();
  return mill;
}

const ArrayXd& theta(const LoadHistory& loads) {
  return loads.quantity("theta").values;
}

/// Laboratory mill, damped eight times as much: transients fall by e in some 2 I / c_theta = 0.05 s.
VibratoryMill well_damped() {
  auto mill = machines::laboratory();
  for (auto& spring : mill.springs) spring.damping_N_s_m *= 8;
  return mill;
}

/// Deviation from steady running at the same instants, relative to its largest value.
double deviation(const LoadHistory& run, const VibratoryMill& mill, const std::string& name, int per_turn,
                 int last_turns) {
  const int turns = int(run.n_instants() - 1) / per_turn;
  const auto loads = compute_loads(mill, all_effects(mill), {turns, per_turn});
  const ArrayXd& steady = loads.quantity(name).values;
  const Index n = Index(last_turns) * per_turn, first = steady.size() - n;
  return largest(run.quantity(name).values.segment(first, n) - steady.segment(first, n)) / largest(steady);
}

std::string refusal(const RunUp& run, const VibratoryMill& mill = machines::laboratory()) {
  try {
    compute_run_up(mill, {"gravity_structure", "springs", "pitch"}, run);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

// Constant speed from a wrong start: once that has died out the loads are those of steady running, up to
// the integration's period error (w h)^2 / 12 with w h = 2 pi / 360 at order 1.
TEST(RunUp, ConstantSpeedBecomesSteady) {
  const auto mill = well_damped();
  const double turn_s = 2 * std::acos(-1.0) / mill.speed_rad_s;
  RunUp run = kinetics::ramp(mill.speed_rad_s, mill.speed_rad_s, 60 * turn_s);
  run.start = kinetics::PitchState{0.05, -1};
  double error[2];
  for (const int fine : {0, 1}) {
    run.steps_per_instant = fine == 0 ? 6 : 12;
    run.step_s = turn_s / (60 * run.steps_per_instant);
    const auto loads = compute_run_up(mill, all_effects(mill), run);
    ASSERT_EQ(loads.n_instants(), 60 * 60 + 1);
    EXPECT_GT(std::abs(theta(loads)[0]), 0.049);
    error[fine] = deviation(loads, mill, "theta", 60, 10);
    for (const char* name : {"R_E", "T", "spring_1.fy", "theta_ddot", "drive_power"})
      EXPECT_LE(deviation(loads, mill, name, 60, 10), fine == 0 ? 1e-4 : 2.5e-5) << name;
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_NEAR(error[0] / error[1], 4, 0.1) << "second order";
}

// The default start is steady, at the run's own first speed rather than the nominal one: nothing happens at
// constant speed.
TEST(RunUp, StartsSteadily) {
  const auto nominal = undamped();
  auto slower = nominal;
  slower.speed_rad_s *= 0.625;
  slower.charge_relative_speed_rad_s *= 0.625;
  for (const auto& mill : {nominal, slower}) {
    const double turn_s = 2 * std::acos(-1.0) / mill.speed_rad_s;
    RunUp run = kinetics::ramp(mill.speed_rad_s, mill.speed_rad_s, 4 * turn_s);
    run.step_s = turn_s / 2000 * (1 + 1e-12);
    run.steps_per_instant = 20;
    EXPECT_LE(deviation(compute_run_up(nominal, all_effects(nominal), run), mill, "theta", 100, 4), 1e-5);
  }
}

TEST(RunUp, AtRestItHangsInItsSprings) {
  const auto mill = machines::laboratory();
  const auto loads = compute_run_up(mill, all_effects(mill), kinetics::ramp(0, 0, 1));
  EXPECT_GT(std::abs(theta(loads)[0]), 1e-3);
  EXPECT_LE(largest(theta(loads) - theta(loads)[0]), 1e-15);
  for (const char* name : {"closure_force", "closure_moment"})
    EXPECT_LE(largest(loads.quantity(name).values), 1e-12);
  EXPECT_EQ(largest(loads.quantity("drive_power").values), 0);
  for (const auto& part : loads.resultant("frame_bearings").contributions)
    if (const std::string& effect = loads.effects[part.effect];
        effect.rfind("gravity", 0) != 0 && effect != "springs") {
      EXPECT_LE(part.load.abs().maxCoeff(), 1e-11) << effect;
    }
}

TEST(RunUp, MotionFollowsTheTable) {
  auto mill = machines::laboratory();
  mill.initial_angle_rad = 0.4;
  RunUp run;
  run.time_s = {1, 2, 4};
  run.speed_rad_s = {10, 50, 20};
  run.step_s = 0.1;
  const auto loads = compute_run_up(mill, {"gravity_charge"}, run);
  ASSERT_EQ(loads.n_instants(), 31);
  EXPECT_NEAR(loads.time_s[10], 2, 1e-15);
  EXPECT_NEAR(loads.speed_rad_s[10], 50, 1e-13);
  EXPECT_NEAR(loads.acceleration_rad_s2[9], 40, 1e-13);
  EXPECT_NEAR(loads.acceleration_rad_s2[10], -15, 1e-13) << "an entry has what comes after it";
  EXPECT_NEAR(loads.phi_rad[10], 0.4 + 30, 1e-13);
  EXPECT_NEAR(loads.phi_rad[30], 0.4 + 30 + 70, 1e-12);
  EXPECT_NEAR(loads.speed_rad_s[30], 20, 1e-13);
  const ArrayXd chi = loads.quantity("chi").values;  // ratio -1/20
  EXPECT_LE(largest(chi - chi[0] + (loads.phi_rad - 0.4) / 20), 1e-12);
}

// Through the resonance without damping: after 1e6 steps the books of the pitch's energy are still balanced.
TEST(RunUp, EnergyOfThePitchIsBalanced) {
  for (const bool damped : {false, true}) {
    const auto mill = damped ? machines::laboratory() : undamped();
    RunUp run = kinetics::ramp(0, 150, 3, 2);
    run.time_s.push_back(8), run.speed_rad_s.push_back(0);
    run.step_s = 8e-6;
    run.steps_per_instant = 100;
    const auto loads = compute_run_up(mill, all_effects(mill), run);
    ASSERT_GT(loads.n_instants(), 10000);
    const double scale = loads.quantity("pitch_energy").values.maxCoeff();
    EXPECT_GT(scale, 1);
    EXPECT_LE(largest(loads.quantity("pitch_energy_residual").values), 1e-10 * scale);
    EXPECT_EQ(largest(loads.quantity("pitch_dissipation").values) == 0, !damped);
    for (const char* name : {"closure_force", "closure_moment"})
      EXPECT_LE(largest(loads.quantity(name).values), 1e-12) << name;
  }
}

TEST(RunUp, RunsToTwiceTheStepsKeepTheInstants) {
  const auto mill = machines::laboratory();
  RunUp run = kinetics::ramp(0, 100, 0.5);
  run.step_s = 1e-3;
  const auto coarse = compute_run_up(mill, {"gravity_charge", "charge_relative"}, run);
  run.step_s = 2.5e-4;
  run.steps_per_instant = 4;
  const auto fine = compute_run_up(mill, {"gravity_charge", "charge_relative"}, run);
  ASSERT_EQ(coarse.n_instants(), fine.n_instants());
  EXPECT_LE(largest(coarse.quantity("R_E").values - fine.quantity("R_E").values),
            1e-12 * largest(fine.quantity("R_E").values));
}

TEST(RunUp, WrongInputIsRefused) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const auto table = [](std::vector<double> time_s, std::vector<double> speed_rad_s) {
    RunUp run;
    run.time_s = std::move(time_s), run.speed_rad_s = std::move(speed_rad_s);
    return run;
  };
  EXPECT_NE(refusal(table({0}, {1})).find("number of run.time_s = 1"), std::string::npos);
  EXPECT_NE(refusal(table({0, 1}, {1})).find("number of run.speed_rad_s = 1"), std::string::npos);
  EXPECT_NE(refusal(table({0, 0}, {1, 2})).find("run.time_s[1] = 0"), std::string::npos);
  EXPECT_NE(refusal(table({0, bad}, {1, 2})).find("run.time_s[1] = nan"), std::string::npos);
  EXPECT_NE(refusal(table({0, 1}, {1, -2})).find("run.speed_rad_s[1] = -2"), std::string::npos);
  EXPECT_NE(refusal(table({0, 1}, {bad, 2})).find("run.speed_rad_s[0] = nan"), std::string::npos);
  auto run = kinetics::ramp(0, 100, 1);
  run.step_s = -1;
  EXPECT_NE(refusal(run).find("run.step_s = -1"), std::string::npos);
  run.step_s = 1e-9;
  EXPECT_NE(refusal(run).find("2 million steps"), std::string::npos);
  run = kinetics::ramp(0, 100, 1);
  run.steps_per_instant = 0;
  EXPECT_NE(refusal(run).find("steps_per_instant = 0"), std::string::npos);
  run = kinetics::ramp(0, 100, 1);
  run.start = kinetics::PitchState{bad, 0};
  EXPECT_NE(refusal(run).find("run.start.theta_rad = nan"), std::string::npos);
  EXPECT_EQ(refusal(kinetics::ramp(0, 100, 1)), "accepted");

  auto mill = machines::laboratory();
  mill.convention = kinetics::Convention::published;
  EXPECT_THROW(compute_run_up(mill, {"springs"}, kinetics::ramp(0, 100, 1)), std::invalid_argument);
  mill = machines::laboratory();
  for (auto& spring : mill.springs) {
    spring.stiffness_N_m.setZero();
    spring.preload_N = Eigen::Vector2d::Zero();
  }
  EXPECT_THROW(compute_run_up(mill, {"gravity_structure", "springs", "pitch"}, kinetics::ramp(0, 100, 1)),
               std::invalid_argument)
      << "nothing holds it at rest";
}
