// Loads over a transient: closed forms of a torque that is switched on, superposition, equilibrium.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetics/values/machine_refused.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using Eigen::ArrayXd;
using kinetics::LoadHistory;
using kinetics::TransientRun;

constexpr double first_J = 0.5, second_J = 2, stiffness = 800, step_Nm = 10;

kinetics::DriveTrain two_masses() {
  auto train = trains::chain({first_J, second_J}, {stiffness});
  train.reference_speed_rad_s = 7;
  return train;
}

/// The torque on the first mass from t = 0 on.
TransientRun switched_on(double step_s, double duration_s) {
  TransientRun run;
  run.time_step_s = step_s;
  run.n_steps = std::lround(duration_s / step_s);
  run.loads = {{"J0", kinetics::torque_step(0, step_Nm)}};
  return run;
}

ArrayXd torque_on(const LoadHistory& loads, const std::string& role) {
  return loads.resultant(role).total.row(2).transpose();
}

double largest_size(const ArrayXd& values) {
  return values.abs().maxCoeff();
}

/// Parts of every resultant add up to its total.
double worst_sum(const LoadHistory& loads) {
  double worst = 0;
  for (const auto& resultant : loads.resultants) {
    Eigen::Array3Xd rest = resultant.total;
    for (const auto& part : resultant.contributions) rest -= part.load;
    worst = std::max(worst, rest.abs().maxCoeff() / std::max(resultant.total.abs().maxCoeff(), 1e-300));
  }
  return worst;
}

}  // namespace

// T on J1: the shaft carries T J2 / (J1 + J2) (1 - cos w t), w^2 = C (1/J1 + 1/J2): twice the static torque.
TEST(TrainTransientLoads, ATorqueSwitchedOnCountsTwice) {
  const double w = std::sqrt(stiffness * (1 / first_J + 1 / second_J)), step_s = 1e-4, duration_s = 0.5;
  const auto loads = compute_transient_loads(two_masses(), {}, switched_on(step_s, duration_s));
  const ArrayXd wanted = step_Nm * second_J / (first_J + second_J) * (1 - (w * loads.time_s).cos());
  // The trapezoidal rule's period is longer by (w dt)^2 / 12, and so it lags by w t times that: 1.7e-5 * 4.
  const double lag = w * duration_s * std::pow(w * step_s, 2) / 12;
  EXPECT_LT(largest_size(loads.quantity("C0.torque").values - wanted),
            1.1 * lag * step_Nm * second_J / (first_J + second_J));
  // The crest lies between instants at most half a step away: (w dt / 2)^2 / 2 of the amplitude.
  EXPECT_NEAR(largest_size(torque_on(loads, "C0_on_J1")), 2 * step_Nm * second_J / (first_J + second_J),
              2e-6 * step_Nm);
  EXPECT_LT(largest_size(loads.quantity("closure").values), 1e-12);
  EXPECT_LT(worst_sum(loads), 1e-14);
  EXPECT_EQ(loads.effects, std::vector<std::string>{"transient_torque_on_J0"});
}

// The train as a whole speeds up by T / (J1 + J2): what <inertia>.angle and uniform running add up to is the
// integral of the true speed, from standstill.
TEST(TrainTransientLoads, AnglesAreThoseOfTheTrueSpeed) {
  const auto train = two_masses();
  const auto loads = compute_transient_loads(train, {}, switched_on(1e-4, 0.5));
  const auto angle = [&](const std::string& inertia) -> ArrayXd {
    return mean_speed_rad_s(train, inertia) * loads.time_s + loads.quantity(inertia + ".angle").values;
  };
  // Centre of both masses: exact for a constant acceleration, whatever the step.
  const ArrayXd centre = (first_J * angle("J0") + second_J * angle("J1")) / (first_J + second_J);
  EXPECT_LT(largest_size(centre - step_Nm / (first_J + second_J) * loads.time_s.square() / 2), 1e-12);
  EXPECT_LT(largest_size(loads.phi_rad - angle("J0")), 1e-14);
  EXPECT_NEAR(loads.phi_rad[0], 0, 1e-300);
  EXPECT_EQ(loads.speed_rad_s[0], 0);
  EXPECT_NEAR(loads.acceleration_rad_s2[0], step_Nm / first_J, 1e-12 * step_Nm / first_J);
}

// Gears, belts, branches, damping of all kinds, excitations and loads together, initial speeds: the parts add
// up to the run of all of them, and every inertia is in equilibrium.
TEST(TrainTransientLoads, PartsAddUpAndClose) {
  auto train = trains::mok150("working");
  train.modal_damping_ratio = 0.01;
  train.elements[1].damping_N_m_s = 0.5;
  train.inertias[4].damping_N_m_s = 0.3;
  TransientRun run;
  run.time_step_s = 1e-4;
  run.n_steps = 3000;
  run.store_every = 3;
  run.loads = {{"rotor", kinetics::torque_step(0.01, 8)},
               {"disc", kinetics::torque_table({0, 0.1}, {0, -9})},
               {"rotor", kinetics::torque_step(0.1, -3)}};
  run.speed_rad_s = ArrayXd::Zero(5);
  run.speed_rad_s[3] = 2;
  std::vector<std::string> effects;
  for (const auto& info : drive_train_effects(train)) effects.push_back(info.name);
  const auto loads = compute_transient_loads(train, effects, run);
  const auto whole = transient(train, run);
  ASSERT_EQ(loads.n_instants(), whole.motion.time_s.size());
  for (std::size_t e = 0; e < train.elements.size(); ++e) {
    const ArrayXd wanted = whole.motion.torque_Nm.row(Eigen::Index(e)).transpose();
    // Rounding of 3000 steps, in modal coordinates.
    EXPECT_LT(largest_size(loads.quantity(train.elements[e].name + ".torque").values - wanted),
              1e-9 * largest_size(wanted))
        << e;
  }
  EXPECT_LT(largest_size(loads.quantity("closure").values), 1e-12);
  EXPECT_LT(worst_sum(loads), 1e-13);
  EXPECT_EQ(loads.resultant("excitation_on_rotor").contributions.size(), 2u)
      << "mains, and both loads as one";
  EXPECT_EQ(loads.effects.front(), train.excitations.front().name);
  EXPECT_NE(std::find(loads.effects.begin(), loads.effects.end(), "initial_motion"), loads.effects.end());
  EXPECT_NE(std::find(loads.effects.begin(), loads.effects.end(), "modal_damping"), loads.effects.end());
}

TEST(TrainTransientLoads, AreThoseOfTheNamedEffects) {
  auto train = two_masses();
  train.excitations = {trains::harmonic("J0", 3, 20)};
  train.elements[0].damping_N_m_s = 5;
  auto run = switched_on(1e-3, 0.1);
  const auto with = compute_transient_loads(train, {"element_damping"}, run);
  const auto without = compute_transient_loads(train, {}, run);
  EXPECT_EQ(with.effects, (std::vector<std::string>{"transient_torque_on_J0", "element_damping"}));
  EXPECT_EQ(without.effects, std::vector<std::string>{"transient_torque_on_J0"});
  EXPECT_GT(largest_size(torque_on(with, "C0_on_J1") - torque_on(without, "C0_on_J1")), 0.01 * step_Nm);
  run.with_excitations = false;
  const auto alone = compute_transient_loads(train, {train.excitations[0].name}, run);
  EXPECT_EQ(largest_size(torque_on(alone, "C0_on_J1") - torque_on(without, "C0_on_J1")), 0);
  EXPECT_THROW(compute_transient_loads(train, {"no such effect"}, run), kinetics::MachineRefused);
}

TEST(TrainTransientLoads, CoarseInstantsAreToldOf) {
  auto run = switched_on(1e-4, 0.5);
  EXPECT_TRUE(compute_transient_loads(two_masses(), {}, run).warnings.empty());
  run.store_every = 200;  // 20 ms; the period is 140 ms
  const auto warnings = compute_transient_loads(two_masses(), {}, run).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("7 stored instants per period"), std::string::npos) << warnings[0];
}

// Torques in balance but for rounding, 3.744 N m through 0.375 against 9.984 N m, accelerate nothing.
TEST(TrainTransientLoads, RoundingIsNoAcceleration) {
  auto train = trains::mok150("working");
  train.excitations = {{"motor", "rotor", 3.744, {}, {}}, {"brake", "disc", -9.984, {}, {}}};
  const auto response = forced_response(train);
  EXPECT_EQ(response.rigid_acceleration_rad_s2, 0);
  EXPECT_TRUE(response.warnings.empty());
  train.excitations[1].constant_Nm = -9.98399999;
  EXPECT_GT(forced_response(train).rigid_acceleration_rad_s2, 0);
}
