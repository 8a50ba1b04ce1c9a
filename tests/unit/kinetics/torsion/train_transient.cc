// Time stepping against closed forms, energy and the steady state.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "kinetics/values/constants.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using kinetics::pi;

/// P19: 2 kg m2 on 800 N m/rad against a held end.
kinetics::DriveTrain oscillator() {
  auto train = trains::chain({1, 2}, {800});
  train.inertias[0].held = true;
  return train;
}

double balance(const kinetics::Transient& t) {
  const Eigen::ArrayXd sum = t.kinetic_J + t.potential_J + t.dissipated_J - t.work_J;
  return (sum - sum[0]).abs().maxCoeff() / (t.kinetic_J + t.potential_J).maxCoeff();
}

}  // namespace

TEST(TrainTransient, UndampedEnergyOverAMillionSteps) {
  const auto train = trains::mok150("working");
  kinetics::TransientRun run;
  run.time_step_s = 2e-5;
  run.n_steps = 1000000;
  run.store_every = 1000;
  run.with_excitations = false;
  run.speed_rad_s = Eigen::ArrayXd::Zero(5);
  run.speed_rad_s[0] = 1;
  run.speed_rad_s[3] = -2;
  const auto result = transient(train, run);
  const Eigen::ArrayXd energy = result.kinetic_J + result.potential_J;
  const double worst = (energy / energy[0] - 1).abs().maxCoeff();
  std::cout << "energy over 1e6 steps: " << worst << '\n';
  EXPECT_LT(worst, 1e-8);
  EXPECT_TRUE(result.motion.torque_Nm.isFinite().all());
}

// x = M/C (1 - cos wt), and second order in the step. Goes red for any damping of the method.
TEST(TrainTransient, P19_step_converges_with_second_order) {
  const auto error = [](long n) {
    kinetics::TransientRun run;
    run.time_step_s = 1.0 / double(n);
    run.n_steps = n;
    run.loads = {{"J1", kinetics::torque_step(0, 10)}};
    const auto motion = transient(oscillator(), run).motion;
    const Eigen::ArrayXd wanted = 10.0 / 800 * (1 - (20 * motion.time_s).cos());
    return (motion.angle_rad.row(1).transpose() - wanted).abs().maxCoeff();
  };
  EXPECT_NEAR(std::log2(error(2000) / error(4000)), 2, 0.01);
  EXPECT_LT(error(4000), 1e-6);
}

// Undamped resonance grows without end: x = F/(2k) (sin wt - wt cos wt).
TEST(TrainTransient, P19_resonance_growth) {
  kinetics::TransientRun run;
  run.time_step_s = 1e-5;
  run.n_steps = 100000;
  run.store_every = 100;
  run.loads = {{"J1", [](double t) { return 10 * std::sin(20 * t); }}};
  const auto result = transient(oscillator(), run);
  const Eigen::ArrayXd wt = 20 * result.motion.time_s;
  const Eigen::ArrayXd wanted = 10.0 / 1600 * (wt.sin() - wt * wt.cos());
  EXPECT_LT((result.motion.angle_rad.row(1).transpose() - wanted).abs().maxCoeff(),
            1e-6 * wanted.abs().maxCoeff());
  EXPECT_LT(balance(result), 1e-11);
}

TEST(TrainTransient, EndsInTheSteadyState) {
  for (const double modal : {0.0, 0.03}) {
    auto train = trains::mok150("working");
    train.modal_damping_ratio = modal;
    for (auto& element : train.elements) element.damping_N_m_s = *element.stiffness_N_m_rad * 2e-4;
    train.elements[1].loss_factor = 0.1;
    train.inertias[4].damping_N_m_s = 4;
    const auto steady = forced_response(train);
    kinetics::TransientRun run;
    run.time_step_s = 1e-5;
    run.n_steps = 100000;
    run.store_every = 10;
    run.loss_frequency_rad_s = 100 * pi;
    const auto result = transient(train, run);
    const auto wanted = over_time(train, steady, result.motion.time_s);
    const auto late = result.motion.torque_Nm.rightCols(1000), aim = wanted.torque_Nm.rightCols(1000);
    EXPECT_LT((late - aim).abs().maxCoeff(), 1e-3 * aim.abs().maxCoeff()) << modal;
    EXPECT_LT(balance(result), 1e-11);
  }
}

// Speeding up through the first resonance: finite, in balance, and with a peak after the crossing.
TEST(TrainTransient, StartUpThroughAResonance) {
  auto train = trains::mok150("working");
  train.modal_damping_ratio = 0.01;
  const double sweep = 2 * pi * 200 / 4;  // 0 to 200 Hz in 4 s
  kinetics::TransientRun run;
  run.time_step_s = 5e-5;
  run.n_steps = 80000;
  run.with_excitations = false;
  run.loads = {{"rotor", [&](double t) { return std::cos(sweep * t * t / 2); }},
               {"disc", kinetics::torque_table({0, 1, 2}, {0, -3, -3})}};
  const auto result = transient(train, run);
  Eigen::Index peak = 0;
  result.motion.torque_Nm.row(1).abs().maxCoeff(&peak);
  const double crossing_s = natural_modes(train).frequency_rad_s[1] / sweep;
  EXPECT_GT(result.motion.time_s[peak], crossing_s);
  EXPECT_LT(result.motion.time_s[peak], crossing_s + 0.2);
  EXPECT_GT(std::abs(result.motion.torque_Nm(1, peak)), 5);
  EXPECT_TRUE(result.motion.acceleration_rad_s2.isFinite().all());
  EXPECT_LT(balance(result), 1e-11);
}

TEST(TrainTransient, RigidGearStartsWithObedientSpeedsOnly) {
  auto train = trains::chain({1, 1, 1}, {100, 1});
  train.elements[1].kind = kinetics::ElementKind::gear;
  train.elements[1].stiffness_N_m_rad.reset();
  train.elements[1].rigid = true;
  train.elements[1].ratio = -2;
  train.inertias[2].shaft = "t";
  kinetics::TransientRun run;
  run.time_step_s = 1e-3;
  run.n_steps = 100;
  run.speed_rad_s = Eigen::Array3d(0, 1, -2);
  const auto result = transient(train, run);
  EXPECT_LT((result.motion.angle_rad.row(2) + 2 * result.motion.angle_rad.row(1)).abs().maxCoeff(), 1e-14);
  const Eigen::ArrayXXd last =
      result.motion.acceleration_rad_s2.row(2) * 1.0 - result.motion.torque_Nm.row(1) / -2;
  EXPECT_LT(last.abs().maxCoeff(), 1e-12) << "the gear alone moves the last inertia";
  run.speed_rad_s[2] = 1;
  EXPECT_THROW(transient(train, run), std::invalid_argument);
}
