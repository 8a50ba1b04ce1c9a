#include <gtest/gtest.h>

#include <cmath>

#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory_effects/springs.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::ArrayXd;
using kinetics::VibratoryMill;
using machines::effects_without;
using machines::largest;

std::string refusal(const VibratoryMill& mill, const std::vector<std::string>& effects) {
  try {
    compute_loads(mill, effects, {1, 12});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// The laboratory mill, undamped, with springs scaled so that k_theta = inertia * w^2.
VibratoryMill tuned(double w, double inertia_kg_m2) {
  auto mill = machines::laboratory();
  const double factor = inertia_kg_m2 * w * w / kinetics::vibratory::pitch_stiffness_Nm(mill.springs);
  for (auto& spring : mill.springs) {
    spring.stiffness_N_m *= factor;
    spring.damping_N_s_m.setZero();
  }
  return mill;
}

ArrayXd derivative(const ArrayXd& f, double step_s) {
  const Eigen::Index n = f.size() - 4;
  return (f.segment(0, n) - 8 * f.segment(1, n) + 8 * f.segment(3, n) - f.segment(4, n)) / (12 * step_s);
}

}  // namespace

// The equilibrium tests tie theta'' to the moments; this ties theta and theta' to theta''. Fastest harmonic:
// phi + chi and 2 phi at most, so w h <= 2 * 2 pi / 720 = 0.017 and the differences err by (w h)^4 / 30 =
// 3e-9.
TEST(VibratoryPitch, RatesAreTheDerivativesOfTheta) {
  const auto mill = machines::laboratory();
  const auto loads = compute_loads(mill, effects_without(mill, {"charge_lag"}), {20, 720});
  const ArrayXd &theta = loads.quantity("theta").values, &rate = loads.quantity("theta_dot").values,
                &acceleration = loads.quantity("theta_ddot").values;
  const double step_s = loads.time_s[1];
  const Eigen::Index n = theta.size() - 4;
  EXPECT_LE(largest(derivative(theta, step_s) - rate.segment(2, n)), 1e-8 * largest(rate));
  EXPECT_LE(largest(derivative(rate, step_s) - acceleration.segment(2, n)), 1e-8 * largest(acceleration));
}

// At a crawl the chamber hangs on its springs: k_theta theta is the moment that the held chamber leaves.
// Dynamics enter with I w^2 / k_theta = 4e-8 at 0.01 rad/s.
TEST(VibratoryPitch, SlowMachinePitchesStatically) {
  auto mill = machines::laboratory();
  mill.speed_rad_s = 0.01;
  mill.charge_relative_speed_rad_s = -0.0105;
  for (auto& spring : mill.springs) spring.damping_N_s_m.setZero();
  const auto free =
      compute_loads(mill, effects_without(mill, {"charge_lag", "charge_follows_pitch"}), {1, 36});
  const auto held =
      compute_loads(mill, effects_without(mill, {"charge_lag", "charge_follows_pitch", "pitch"}), {1, 36});
  const ArrayXd& residual = held.quantity("moment_residual").values;
  EXPECT_LE(largest(7001.2 * free.quantity("theta").values - residual), 1e-6 * largest(residual));
}

TEST(VibratoryPitch, AChargeThatFollowsMakesTheChamberPitchLess) {
  const auto mill = machines::laboratory();
  const double alone =
      largest(compute_loads(mill, effects_without(mill, {"charge_lag", "charge_follows_pitch"}), {20, 90})
                  .quantity("theta")
                  .values);
  const double followed =
      largest(compute_loads(mill, effects_without(mill, {"charge_lag"}), {20, 90}).quantity("theta").values);
  // The documentation says a third; a fifth to a third and a bit is what springs of this kind leave.
  EXPECT_GT(followed / alone, 0.64);
  EXPECT_LT(followed / alone, 0.80);
}

TEST(VibratoryPitch, OnlyTheHarmonicsThatAreThere) {
  const auto mill = machines::laboratory();
  // Inertia of the structure alone turns with phi: one harmonic.
  const auto one = solve_pitch(mill, kinetics::vibratory::make_effects(mill, {"structure_inertia", "pitch"}));
  ASSERT_EQ(one.harmonics.size(), 1u);
  EXPECT_EQ(one.harmonics[0].p, 1);
  EXPECT_EQ(one.harmonics[0].q, 0);
  // theta = p x F / (-I w^2) in phase: m1 ecc w^2 (l_x sin + l_y cos) / (I w^2), amplitude m1 ecc |l| / I.
  EXPECT_NEAR(std::abs(one.harmonics[0].amplitude_rad), 30 * 0.004 * std::hypot(0.26, 0.02) / 2.85, 1e-15);
}

TEST(VibratoryPitch, ResonanceIsRefusedByItsFrequency) {
  const double omega = machines::laboratory().speed_rad_s;
  const auto mill = tuned(omega, 2.85);
  const auto effects = effects_without(mill, {"charge_lag", "charge_follows_pitch"});
  const auto message = refusal(mill, effects);
  EXPECT_NE(message.find("resonance"), std::string::npos) << message;
  EXPECT_NE(message.find("151.844 rad/s"), std::string::npos) << message;
  // The slow circulation of the charge excites as well: 0.05 omega, with the charge carried along.
  const auto slow = tuned(0.05 * omega, 2.85 + 20 * (0.28 * 0.28 + 0.04 * 0.04));
  const auto slow_message = refusal(slow, effects_without(slow, {"charge_lag"}));
  EXPECT_NE(slow_message.find("7.5922 rad/s"), std::string::npos) << slow_message;
}

TEST(VibratoryPitch, ResonanceIsHarmlessIfDampedOrNotExcited) {
  auto mill = tuned(machines::laboratory().speed_rad_s, 2.85);
  EXPECT_EQ(refusal(mill, {"springs", "gravity_structure", "pitch"}).find("accepted") == 0, false)
      << "the springs' own stretch turns with the drive and excites";
  EXPECT_EQ(refusal(mill, {"gravity_charge", "springs", "pitch", "structure_inertia"}).find("accepted") == 0,
            false);
  mill.eccentricity_m = 0;  // gravity of the circulating charge alone: 7.6 rad/s
  EXPECT_EQ(refusal(mill, {"gravity_charge", "springs", "pitch", "structure_inertia"}), "accepted");
  mill = tuned(machines::laboratory().speed_rad_s, 2.85);
  for (auto& spring : mill.springs) spring.damping_N_s_m = {30, 60};
  EXPECT_EQ(refusal(mill, effects_without(mill, {"charge_lag", "charge_follows_pitch"})), "accepted");
}

TEST(VibratoryPitch, AMeanMomentNeedsStiffness) {
  auto mill = machines::laboratory();
  for (auto& spring : mill.springs) {
    spring.stiffness_N_m.setZero();
    spring.preload_N = Eigen::Vector2d::Zero();  // given, so that it does not balance the weight
  }
  const auto message = refusal(mill, {"gravity_structure", "springs", "pitch"});
  EXPECT_NE(message.find("k_theta = 0"), std::string::npos) << message;
  EXPECT_NE(message.find("76.518 N m"), std::string::npos) << message;  // 30 kg * 9.81 * 0.26 m
  EXPECT_EQ(refusal(mill, {"structure_inertia", "springs", "pitch"}), "accepted") << "no mean moment";
  EXPECT_NE(refusal(mill, {"structure_inertia", "pitch"}).find("needs the effect springs"),
            std::string::npos);
}
