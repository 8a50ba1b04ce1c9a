// Over a whole period the drive pays for what the springs dissipate and the charge takes. T comes from
// statics, the powers from forces and velocities: a wrong torque, velocity or pitch rate breaks the balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using machines::effects_without;
using machines::largest;

// All powers are trigonometric polynomials of low degree: equidistant instants over the whole period of 20
// turns average them exactly, up to round-off of the largest power.
constexpr double energy_tolerance = 1e-12;
const kinetics::TimeGrid period{20, 120};

void expect_balance(const kinetics::VibratoryMill& mill, const std::vector<std::string>& without) {
  const auto loads = compute_loads(mill, effects_without(mill, without), period);
  const auto& drive = loads.quantity("drive_power").values;
  const auto& charge = loads.quantity("charge_power").values;
  const auto& damping = loads.quantity("damping_power").values;
  const double scale = std::max({largest(drive), largest(charge), largest(damping)});
  EXPECT_NEAR(drive.mean(), damping.mean() + charge.mean(), energy_tolerance * scale);
  EXPECT_GT(damping.minCoeff(), -energy_tolerance * scale);  // a damper takes energy at every instant
  EXPECT_GT(damping.mean(), 1) << "nothing to balance";
}

}  // namespace

TEST(VibratoryEnergy, DrivePaysForDampingAndCharge) {
  auto mill = machines::laboratory();
  ASSERT_EQ(period_in_turns(mill), 20);
  mill.charge_lag.loss_angle_rad = 0.2;
  expect_balance(mill, {"charge_lag", "charge_follows_pitch"});
  expect_balance(mill, {"charge_lag"});
  expect_balance(mill, {});
  expect_balance(mill, {"charge_lag", "charge_follows_pitch", "pitch"});
}

// With the pitch held, the chamber moves on the circle alone, and the lag takes exactly the power it was made
// from.
TEST(VibratoryEnergy, ChargeLagRaisesTheMeanDrivePowerByTheGrindingPower) {
  auto mill = machines::laboratory();
  const std::vector<std::string> held{"pitch", "charge_follows_pitch"};
  const auto power_with = [&](const std::vector<std::string>& without) {
    return compute_loads(mill, effects_without(mill, without), period).quantity("drive_power").values;
  };
  const auto without_lag = power_with({"pitch", "charge_follows_pitch", "charge_lag"});
  mill.charge_lag.grinding_power_W = 750;
  const auto with_lag = power_with(held);
  EXPECT_NEAR(with_lag.mean() - without_lag.mean(), 750, energy_tolerance * largest(with_lag));

  // The same by the angle: P = m ecc^2 omega^3 sin(eta).
  mill.charge_lag = {std::asin(750 / (20 * 0.004 * 0.004 * std::pow(151.844, 3))), std::nullopt};
  EXPECT_LE(largest(power_with(held) - with_lag), energy_tolerance * largest(with_lag));
}
