// Excitation at and beside natural frequencies.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/kinetics/torsion/trains.h"

namespace {

std::string refusal(const kinetics::DriveTrain& train) {
  try {
    forced_response(train);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(TrainResonance, UndampedExcitationAtANaturalFrequencyIsRefusedByBothFrequencies) {
  auto train = trains::chain({5, 11, 22}, {1e5, 2e5});
  const double w = natural_modes(train).frequency_rad_s[2];
  train.excitations = {trains::harmonic("J0", 1, w)};
  const auto message = refusal(train);
  EXPECT_NE(message.find("torque_on_J0 at 202.65834859 rad/s"), std::string::npos) << message;
  EXPECT_NE(message.find("natural frequency 202.65834859 rad/s"), std::string::npos) << message;
  EXPECT_NE(message.find("mode 2"), std::string::npos) << message;
  EXPECT_THROW(compute_loads(train, {"torque_on_J0"}, {1, 12}), std::invalid_argument);
  train.modal_damping_ratio = 0.01;
  EXPECT_EQ(refusal(train), "accepted");
  EXPECT_THROW(compute_loads(train, {"torque_on_J0"}, {1, 12}), std::invalid_argument) << "damping is off";
  EXPECT_NO_THROW(compute_loads(train, {"torque_on_J0", "modal_damping"}, {1, 12}));
}

// Beside it by 1e-9 the response is that of the one mode, 1 / (1 - r^2); the frequency itself is known to
// 1e-15 or so, hence the answer to 1e-6.
TEST(TrainResonance, ABillionthBesideItTheModeStandsAlone) {
  auto train = trains::chain({5, 11, 22}, {1e5, 2e5});
  const auto modes = natural_modes(train);
  const double w_k = modes.frequency_rad_s[2];
  for (const double side : {-1e-9, 1e-9}) {
    const double w = w_k * (1 + side);
    train.excitations = {trains::harmonic("J0", 1, w)};
    const auto response = forced_response(train);
    const Eigen::Array3d J(5, 11, 22);
    const Eigen::ArrayXd q = modes.reduced_shape.col(2);
    const Eigen::ArrayXd wanted = q * q[0] / (J * q.square()).sum() / ((w_k - w) * (w_k + w));
    const Eigen::ArrayXd got = response.harmonics[0].angle_rad.real();
    EXPECT_LT((got - wanted).abs().maxCoeff() / wanted.abs().maxCoeff(), 1e-6);
    ASSERT_EQ(response.warnings.size(), 1u);
    EXPECT_NE(response.warnings[0].find("amplified up to 49999995"), std::string::npos)
        << response.warnings[0];
  }
}

TEST(TrainResonance, DampedAmplificationIsHalfTheInverseDamping) {
  auto train = trains::chain({1, 1}, {200});
  train.elements[0].loss_factor = 0.02;
  train.excitations = {trains::harmonic("J0", 1, 20)};
  const auto response = forced_response(train);
  ASSERT_EQ(response.warnings.size(), 1u);
  EXPECT_NE(response.warnings[0].find("amplified up to 50 times"), std::string::npos) << response.warnings[0];
  EXPECT_NEAR(std::abs(response.harmonics[0].torque_Nm[0]), 0.5 * std::hypot(1, 0.02) / 0.02, 1e-12 * 25);
}

// Near the resonance of one element with loss factor 0.035 nothing is amplified more than 1/0.035 times, and
// the margin has the number of the warning. Red with the formula without damping, which has 50 there.
TEST(TrainResonance, MarginsAreAmplifiedAsTheWarningSays) {
  auto train = trains::chain({1, 1}, {200});  // 20 rad/s
  train.elements[0].loss_factor = 0.035;
  train.excitations = {trains::harmonic("J0", 1, 20 * 1.01), trains::harmonic("J1", 1, 20)};
  const auto margins = resonance_margins(train);
  ASSERT_EQ(margins.size(), 2u);
  EXPECT_NEAR(margins[0].amplification, 1 / 0.035, 1e-9);
  EXPECT_NEAR(margins[0].damping_ratio, 0.0175, 1e-12);
  EXPECT_NEAR(margins[1].amplification, 1 / std::hypot(1.01 * 1.01 - 1, 0.035 * 1.01), 1e-9);
  const auto warnings = forced_response(train).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE((warnings[0] + warnings[1]).find("amplified up to 28.57 times"), std::string::npos)
      << warnings[0];
  EXPECT_NE((warnings[0] + warnings[1]).find("amplified up to 24.59 times"), std::string::npos)
      << warnings[0];
  train.elements[0].loss_factor = 0;
  train.excitations.pop_back();
  EXPECT_NEAR(resonance_margins(train)[0].amplification, 1 / (1.01 * 1.01 - 1), 1e-9);
  EXPECT_EQ(resonance_margins(train)[0].damping_ratio, 0);
}

// A damper that the mode does not move damps nothing.
TEST(TrainResonance, DamperAtANodeOfTheModeDoesNotHelp) {
  auto train = trains::chain({1, 1, 1}, {100, 100});
  train.inertias[1].damping_N_m_s = 3;
  const double w = natural_modes(train).frequency_rad_s[1];
  train.excitations = {trains::harmonic("J0", 1, w)};
  EXPECT_NE(refusal(train).find("nothing damps"), std::string::npos) << refusal(train);
}

// Three equal branches, one damped: at their common frequency the other two swing against each other for
// ever.
TEST(TrainResonance, RepeatedFrequencyNeedsDampingInEveryCombination) {
  auto train = trains::chain({1, 2, 2, 2}, {200, 200, 200});
  for (auto& element : train.elements) element.first = "J0";
  train.inertias[1].damping_N_m_s = 1;
  train.excitations = {trains::harmonic("J2", 1, 10)};
  EXPECT_NE(refusal(train).find("nothing damps"), std::string::npos) << refusal(train);
  train.inertias[2].damping_N_m_s = 1;
  EXPECT_EQ(refusal(train), "accepted");
  EXPECT_TRUE(forced_response(train).harmonics.at(0).angle_rad.isFinite().all());
}

TEST(TrainResonance, MarginsAndCampbellNameOrderAndMode) {
  auto train = trains::mok150("working");
  train.excitations = {trains::harmonic("rotor", 1, 2 * std::acos(-1.0) * 100)};
  kinetics::TrainExcitation blades;
  blades.name = "blades", blades.inertia = "disc";
  blades.harmonics.push_back({1, std::nullopt, 8.0, "working", 0});
  train.excitations.push_back(blades);
  const auto margins = resonance_margins(train);
  ASSERT_EQ(margins.size(), 2u);
  EXPECT_EQ(margins[0].line.excitation, "torque_on_rotor");
  EXPECT_EQ(margins[0].mode, 1);
  EXPECT_NEAR(margins[0].margin, 100 / 94.142 - 1, 1e-5);
  EXPECT_DOUBLE_EQ(margins[1].line.order, 3);  // 8 of a shaft at 0.375 of the reference's speed
  EXPECT_NEAR(margins[1].line.frequency_rad_s, 3 * train.reference_speed_rad_s, 1e-10);
  const auto table = campbell_table(train, 0, 300, 4, {6.0});
  ASSERT_EQ(table.lines.size(), 3u);
  EXPECT_EQ(table.lines[1].excitation, "blades");
  EXPECT_EQ(table.lines[2].excitation, "") << "nothing excites a further order";
  EXPECT_EQ(table.lines[2].order, 6);
  EXPECT_EQ(table.line_frequency_rad_s(0, 0), table.line_frequency_rad_s(0, 3));
  EXPECT_DOUBLE_EQ(table.line_frequency_rad_s(1, 2), 600);
  ASSERT_EQ(table.crossings.size(), 2u);
  const double w_1 = natural_modes(train).frequency_rad_s[1];
  EXPECT_NEAR(table.crossings[0].speed_rad_s, w_1 / 3, 1e-10);
  EXPECT_NEAR(table.crossings[1].speed_rad_s, w_1 / 6, 1e-10);
  EXPECT_EQ(table.crossings[1].mode, 1);
}
