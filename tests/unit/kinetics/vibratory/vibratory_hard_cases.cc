// Limits in which a formula could divide by zero or an effect should vanish.
#include <gtest/gtest.h>

#include <regex>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using kinetics::LoadHistory;
using kinetics::VibratoryMill;
using machines::effects_without;
using machines::largest;

const kinetics::TimeGrid grid{2, 60};

LoadHistory all_effects(const VibratoryMill& mill) {
  auto loads = compute_loads(mill, effects_without(mill, {"charge_lag"}), grid);
  for (const auto& quantity : loads.quantities) EXPECT_TRUE(quantity.values.allFinite()) << quantity.name;
  EXPECT_LE(largest(loads.quantity("closure_force").values), 1e-12);
  EXPECT_LE(largest(loads.quantity("closure_moment").values), 1e-12);
  return loads;
}

Eigen::Array3Xd charge_part(const LoadHistory& loads, const std::string& effect) {
  for (const auto& part : loads.resultant("inner_wall").contributions)
    if (loads.effects[part.effect] == effect) return part.load;
  ADD_FAILURE() << effect;
  return {};
}

}  // namespace

TEST(VibratoryHardCases, ChargeInTheChamberCentre) {
  auto mill = machines::laboratory();
  mill.charge_offset_m = 0;
  const auto loads = all_effects(mill);
  EXPECT_EQ(loads.resultant("inner_wall").total.row(2).abs().maxCoeff(), 0);  // no arm, no torque
  EXPECT_EQ(charge_part(loads, "charge_coriolis").abs().maxCoeff(), 0);
  EXPECT_EQ(period_in_turns(mill), 1);  // where the charge points no longer matters
}

TEST(VibratoryHardCases, NoEccentricity) {
  auto mill = machines::laboratory();
  mill.eccentricity_m = 0;
  const auto loads = all_effects(mill);
  // The eccentric's axis does not move: the torque only lifts the debalance, 4 kg at 10 mm.
  const Eigen::ArrayXd lift = -4 * 9.81 * 0.01 * loads.phi_rad.cos();
  EXPECT_LE(largest(loads.quantity("T").values - lift), 1e-14);
}

TEST(VibratoryHardCases, ChargeTurnsWithTheDrive) {
  auto mill = machines::laboratory();
  mill.charge_relative_speed_rad_s = 0;
  const auto loads = all_effects(mill);
  EXPECT_EQ(charge_part(loads, "charge_coriolis").abs().maxCoeff(), 0);
  EXPECT_EQ(charge_part(loads, "charge_relative").abs().maxCoeff(), 0);
  EXPECT_EQ(period_in_turns(mill), 1);
}

// A charge whose centre does not turn in space feels only the translation: its centripetal, Coriolis and
// relative terms are m r omega^2 (1 - 2 + 1). The published formulas lack the first, erratum 1.
TEST(VibratoryHardCases, ChargeAtRestInSpace) {
  auto mill = machines::laboratory();
  mill.charge_relative_speed_rad_s = -mill.speed_rad_s;
  const auto loads = all_effects(mill);
  const Eigen::Array3Xd circulation = charge_part(loads, "charge_centripetal") +
                                      charge_part(loads, "charge_coriolis") +
                                      charge_part(loads, "charge_relative");
  EXPECT_LE(circulation.abs().maxCoeff(), 1e-12 * charge_part(loads, "charge_coriolis").abs().maxCoeff());
  EXPECT_EQ(period_in_turns(mill), 1);
}

TEST(VibratoryHardCases, NoSpringsAndPitchHeld) {
  auto mill = machines::laboratory();
  mill.springs.clear();
  const auto loads = compute_loads(
      mill,
      effects_without(mill, {"springs", "spring_damping", "pitch", "charge_follows_pitch", "charge_lag"}),
      {20, 90});
  EXPECT_LE(largest(loads.quantity("closure_force").values), 1e-12);
  EXPECT_FALSE(loads.has_resultant("spring_foot_1"));
  // The figures that the coupling of loads and bodies states for this case, to their print.
  const auto& residual = loads.quantity("moment_residual").values;
  EXPECT_NEAR(largest(residual), 1436, 1);
  EXPECT_NEAR(residual.mean(), -131, 0.6);
}

// Statics of two supports divide by their distance; one alone must lie below the weights, 131.454 N m /
// 549.36 N.
TEST(VibratoryHardCases, OneSpring) {
  auto mill = machines::laboratory();
  mill.springs.pop_back();
  mill.springs[0].position_m.x() = 131.454 / 549.36;
  const auto loads = all_effects(mill);
  EXPECT_TRUE(loads.has_resultant("spring_foot_1"));
  EXPECT_FALSE(loads.has_resultant("spring_foot_2"));
  EXPECT_LE(largest(loads.quantity("spring_force").values - loads.quantity("spring_1.fy").values), 0);
}

// All else is then small beside the springs: the chamber pitches so that their moments cancel, whatever their
// stiffness, k_theta theta = -sum p x (k s).
TEST(VibratoryHardCases, Springs1e12TimesStiffer) {
  auto mill = machines::laboratory();
  for (auto& spring : mill.springs) spring.stiffness_N_m *= 1e12;
  const auto loads = all_effects(mill);
  const double kx = 2 * 14000, ky = 2 * 27500, x_m = 0.28, y_m = -0.18,
               k_theta = 7001.2;  // means: equal springs
  const Eigen::ArrayXd sx = 0.004 * loads.phi_rad.cos(), sy = -0.004 * loads.phi_rad.sin();
  const Eigen::ArrayXd theta = -(x_m * ky * sy - y_m * kx * sx) / k_theta;
  // What else there is, damping and inertia, is 1e-12 and 1e-11 of the springs' moment.
  EXPECT_LE(largest(loads.quantity("theta").values - theta), 1e-10 * largest(theta));
}

// Beside the pitch's resonance by relative 1e-9 in frequency lies the border between what is refused and what
// is computed (2e-9 of the stiffness). On the outer side the answer is finite, large and still an
// equilibrium.
TEST(VibratoryHardCases, BesideTheResonanceOfPitch) {
  const auto beside = [](double relative) {
    auto mill = machines::laboratory();
    const double w = mill.speed_rad_s * (1 + relative);
    for (auto& spring : mill.springs) {
      spring.stiffness_N_m *= 2.85 * w * w / 7001.2;
      spring.damping_N_s_m.setZero();
    }
    return mill;
  };
  const auto effects = effects_without(beside(0), {"charge_lag", "charge_follows_pitch", "spring_damping"});
  for (const double relative : {0.0, 0.9e-9, -0.9e-9})
    EXPECT_THROW(compute_loads(beside(relative), effects, grid), std::invalid_argument) << relative;
  for (const double relative : {1.1e-9, -1.1e-9}) {
    const auto loads = compute_loads(beside(relative), effects, grid);
    for (const auto& quantity : loads.quantities) EXPECT_TRUE(quantity.values.allFinite()) << quantity.name;
    EXPECT_LE(largest(loads.quantity("closure_force").values), 1e-12);
    EXPECT_LE(largest(loads.quantity("closure_moment").values), 1e-12);
    // Ten times as far, a tenth as large; the divisor is a difference that keeps seven digits.
    const auto farther = compute_loads(beside(10 * relative), effects, grid);
    EXPECT_GT(largest(loads.quantity("theta").values), 1e4);
    EXPECT_NEAR(largest(loads.quantity("theta").values) / largest(farther.quantity("theta").values), 10,
                1e-5);
  }
}

TEST(VibratoryHardCases, NoEffectsNoLoads) {
  const auto loads = compute_loads(machines::laboratory(), {}, grid);
  for (const char* name : {"B", "R_E", "T", "closure_force", "closure_moment", "theta"})
    EXPECT_EQ(largest(loads.quantity(name).values), 0) << name;
}

TEST(VibratoryHardCases, AWindowThatIsNoPeriodSaysSo) {
  const auto warned = [](const VibratoryMill& mill, const kinetics::TimeGrid& window) {
    std::string all;
    for (const auto& warning : compute_loads(mill, {"gravity_charge"}, window).warnings) all += warning;
    return all;
  };
  auto mill = machines::laboratory();
  EXPECT_NE(warned(mill, {1, 12}).find("repeats after 20 turns"), std::string::npos);
  EXPECT_EQ(warned(mill, {40, 12}).find("the motion repeats"), std::string::npos);
  mill.charge_relative_speed_rad_s = -159.123456789;
  EXPECT_EQ(period_in_turns(mill), std::nullopt);
  EXPECT_NE(warned(mill, {20, 12}).find("never"), std::string::npos);
}

TEST(VibratoryHardCases, WhatTheUserShouldKnowIsSaid) {
  const auto warned = [](const VibratoryMill& mill, const std::string& sentence) {
    for (const auto& warning : compute_loads(mill, effects_without(mill, {}), {20, 60}).warnings)
      if (std::regex_search(warning, std::regex(sentence))) return true;
    return false;
  };
  auto mill = machines::laboratory();
  mill.charge_lag.loss_angle_rad = 0;
  EXPECT_TRUE(
      warned(mill, "the drive torque reverses in each cycle, from -[0-9.]{4,5} to [0-9.]{4,5} N m: keys"));
  for (const auto& warning : compute_loads(mill, effects_without(mill, {}), {20, 60}).warnings)
    EXPECT_FALSE(std::regex_search(warning, std::regex("[0-9]\\.[0-9]{5}"))) << warning;
  EXPECT_FALSE(warned(mill, "the chamber pitches by up to"));
  EXPECT_FALSE(warned(mill, "pulls the chamber down"));
  EXPECT_FALSE(warned(mill, "charge_lag"));
  mill.charge_lag = {std::nullopt, 100};  // exact with the pitch held only
  EXPECT_TRUE(warned(mill, "charge_lag"));
  mill.eccentricity_m = 0.04;  // ten times as far as it should
  EXPECT_TRUE(warned(mill, "spring_1 pulls the chamber down"));
  EXPECT_TRUE(warned(mill, "the chamber pitches by up to"));
  EXPECT_TRUE(warned(mill, "neglected centripetal force"));
}
