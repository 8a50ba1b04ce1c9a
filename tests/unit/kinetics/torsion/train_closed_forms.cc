// Trains whose answers are known in closed form; tolerances are round-off of a few operations per mass.
#include <gtest/gtest.h>

#include <cmath>

#include "kinetics/values/constants.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using kinetics::pi;

}  // namespace

TEST(TrainClosedForms, TwoMasses) {
  const double J1 = 0.02, J2 = 3, C = 1.7e4;
  const auto modes = natural_modes(trains::chain({J1, J2}, {C}));
  ASSERT_EQ(modes.frequency_rad_s.size(), 2);
  EXPECT_EQ(modes.frequency_rad_s[0], 0);
  EXPECT_DOUBLE_EQ(modes.frequency_rad_s[1], std::sqrt(C * (1 / J1 + 1 / J2)));
  EXPECT_NEAR(modes.reduced_shape(0, 1) / modes.reduced_shape(1, 1), -J2 / J1, 1e-12 * J2 / J1);
  EXPECT_NEAR(modes.kinetic_share(0, 1), J2 / (J1 + J2), 1e-15);
  EXPECT_NEAR(modes.kinetic_share(0, 0), J1 / (J1 + J2), 1e-15);
  EXPECT_NEAR(modes.potential_share(0, 1), 1, 1e-15);
}

TEST(TrainClosedForms, UniformChainFreeAndHeld) {
  const int n = 40;
  const double J = 0.3, C = 5e3;
  auto train = trains::chain(std::vector<double>(n, J), std::vector<double>(n - 1, C));
  const auto free = natural_modes(train);
  for (int k = 0; k < n; ++k) {
    const double wanted = 2 * std::sqrt(C / J) * std::sin(k * pi / (2 * n));
    EXPECT_NEAR(free.frequency_rad_s[k], wanted, 1e-13 * wanted);
    double scale = 0;
    for (int i = 0; i < n; ++i) scale += std::pow(std::cos(k * pi * (i + 0.5) / n), 2);
    const double sign = free.reduced_shape(0, k) > 0 ? 1 : -1;
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(sign * free.reduced_shape(i, k), std::cos(k * pi * (i + 0.5) / n) / std::sqrt(scale),
                  1e-12);
  }
  train.inertias[0].held = true;
  const auto held = natural_modes(train);
  ASSERT_EQ(held.frequency_rad_s.size(), n - 1);
  for (int k = 1; k < n; ++k) {
    const double wanted = 2 * std::sqrt(C / J) * std::sin((2 * k - 1) * pi / (2 * (2 * n - 1)));
    EXPECT_NEAR(held.frequency_rad_s[k - 1], wanted, 1e-13 * wanted);
  }
  EXPECT_EQ(held.reduced_shape.row(0).abs().maxCoeff(), 0);
}

// p equal branches on a hub: sqrt(C / J) p - 1 times, and once with the hub against them.
TEST(TrainClosedForms, StarHasRepeatedFrequencies) {
  const int p = 7;
  const double hub = 0.5, J = 0.02, C = 300;
  auto train = trains::chain(std::vector<double>(p + 1, J), std::vector<double>(p, C));
  train.inertias[0].inertia_kg_m2 = hub;
  for (auto& element : train.elements) element.first = "J0";
  const auto modes = natural_modes(train);
  for (int k = 1; k < p; ++k) EXPECT_NEAR(modes.frequency_rad_s[k] / std::sqrt(C / J), 1, 1e-14);
  EXPECT_NEAR(modes.frequency_rad_s[p] / std::sqrt(C / J + p * C / hub), 1, 1e-14);
  Eigen::ArrayXd inertia = Eigen::ArrayXd::Constant(p + 1, J);
  inertia[0] = hub;
  const Eigen::MatrixXd shape = modes.reduced_shape.matrix();
  Eigen::MatrixXd gram = shape.transpose() * inertia.matrix().asDiagonal() * shape;
  const Eigen::VectorXd size = gram.diagonal().cwiseSqrt();
  gram = size.cwiseInverse().asDiagonal() * gram * size.cwiseInverse().asDiagonal();
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(p + 1, p + 1)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((modes.kinetic_share.colwise().sum() - 1).abs().maxCoeff(), 1e-13);
  EXPECT_LT((modes.potential_share.colwise().sum().tail(p) - 1).abs().maxCoeff(), 1e-13);
}

TEST(TrainClosedForms, HollowShaftStiffnessAndStress) {
  auto train = trains::chain({1, 2}, {1});
  auto& shaft = train.elements[0];
  shaft.stiffness_N_m_rad.reset();
  shaft.shear_modulus_Pa = 80e9;
  shaft.length_m = 0.5;
  shaft.diameter_m = 0.04;
  shaft.bore_m = 0.02;
  shaft.stress_concentration = 1.6;
  const double I_p = pi / 32 * (std::pow(0.04, 4) - std::pow(0.02, 4));
  EXPECT_DOUBLE_EQ(natural_modes(train).frequency_rad_s[1], std::sqrt(80e9 * I_p / 0.5 * 1.5));
  train.excitations = {trains::harmonic("J0", 3, 50, 0.3)};
  const auto history = compute_loads(train, {"torque_on_J0"}, {1, 12});
  const Eigen::ArrayXd wanted = 1.6 * 0.02 / I_p * history.quantity("C0.torque").values;
  EXPECT_LT((history.quantity("C0.shear_stress").values - wanted).abs().maxCoeff(),
            1e-12 * wanted.abs().maxCoeff());
}

// Harmonic of a two-mass train: twist = -(M / J1) / (C (1/J1 + 1/J2) - w^2) seen from the driven mass.
TEST(TrainClosedForms, ForcedTwoMasses) {
  const double J1 = 0.02, J2 = 3, C = 1.7e4, w = 600, M = 5;
  auto train = trains::chain({J1, J2}, {C});
  train.excitations = {trains::harmonic("J0", M, w, 0.4)};
  const auto h = forced_response(train).harmonics.at(0);
  const double torque_Nm = C * M / J1 / (C * (1 / J1 + 1 / J2) - w * w);
  EXPECT_NEAR(std::abs(h.torque_Nm[0] - std::polar(torque_Nm, -0.4)), 0, 1e-13 * torque_Nm);
}

// A gear stage of ratio -1/3 whose wheels have no mass, between a motor and a load: one spring, of both
// shafts in series on the motor's. The wheels are nothing at all (joined rigidly to the motor), or 1e-12 kg
// m2 each, as the refusal of 0 advises, which adds a frequency far above and changes nothing else.
TEST(TrainClosedForms, GearsWithoutMass) {
  const double J1 = 0.02, J2 = 3, C1 = 1.7e4, C2 = 4e5, u = -1.0 / 3, w = 300, M = 5;
  const auto train_with = [&](double wheel_kg_m2, bool is_stiff) {
    kinetics::DriveTrain train;
    train.inertias = {{"motor", "fast", J1},
                      {"pinion", "fast", wheel_kg_m2},
                      {"wheel", "slow", wheel_kg_m2},
                      {"load", "slow", J2}};
    const auto join = [&](const char* name, const char* first, const char* second) {
      kinetics::TrainElement element;
      element.name = name, element.first = first, element.second = second;
      train.elements.push_back(element);
    };
    join("fast_shaft", "motor", "pinion");
    join("gear", "pinion", "wheel");
    join("slow_shaft", "wheel", "load");
    train.elements[1].kind = kinetics::ElementKind::gear;
    train.elements[1].ratio = u;
    train.elements[1].rigid = true;
    train.elements[0].rigid = is_stiff;
    if (!is_stiff) train.elements[0].stiffness_N_m_rad = C1;
    train.elements[2].stiffness_N_m_rad = C2;
    train.reference_shaft = "fast";
    train.reference_speed_rad_s = 150;
    train.excitations = {trains::harmonic("motor", M, w)};
    return train;
  };
  for (const bool is_stiff : {false, true}) {
    const double behind = C2 * u * u, C = is_stiff ? behind : 1 / (1 / C1 + 1 / behind),
                 J2_reduced = J2 * u * u;
    const auto train = train_with(is_stiff ? 0 : 1e-12, is_stiff);
    const double stiff_rad_s = std::sqrt(C * (1 / J1 + 1 / J2_reduced));
    const auto modes = natural_modes(train);
    EXPECT_NEAR(modes.frequency_rad_s[1], stiff_rad_s, 1e-9 * stiff_rad_s);
    if (!is_stiff) {
      EXPECT_GT(modes.frequency_rad_s[2], 1e4 * stiff_rad_s);
    }
    const double torque_Nm = C * M / J1 / (C * (1 / J1 + 1 / J2_reduced) - w * w);
    const auto h = forced_response(train).harmonics.at(0);
    EXPECT_NEAR(std::abs(h.reduced_torque_Nm[2] - torque_Nm), 0, 1e-9 * torque_Nm);
    EXPECT_NEAR(std::abs(h.reduced_torque_Nm[1] - torque_Nm), 0, 1e-9 * torque_Nm);
    if (!is_stiff) {
      EXPECT_NEAR(std::abs(h.reduced_torque_Nm[0] - torque_Nm), 0, 1e-9 * torque_Nm);
    }
  }
}

// A mean torque on a free train: each section carries the share that accelerates what lies behind it.
TEST(TrainClosedForms, MeanTorqueOfAFreeTrain) {
  auto train = trains::chain({1, 2, 3, 4}, {1e3, 1e9, 1e2});
  kinetics::TrainExcitation drive;
  drive.name = "drive", drive.inertia = "J0", drive.constant_Nm = 20;
  train.excitations = {drive};
  auto response = forced_response(train);
  EXPECT_DOUBLE_EQ(response.rigid_acceleration_rad_s2, 2);
  const double torque_Nm[] = {18, 14, 8};
  for (int e = 0; e < 3; ++e) EXPECT_NEAR(response.mean_torque_Nm[e], torque_Nm[e], 1e-14);
  EXPECT_NEAR(response.mean_angle_rad[1] - response.mean_angle_rad[2], 14e-9, 1e-16);
  EXPECT_NEAR((response.mean_angle_rad * Eigen::Array4d(1, 2, 3, 4)).sum(), 0, 1e-15)
      << "about the weighted mean";
  ASSERT_EQ(response.warnings.size(), 1u);
  train.inertias[3].damping_N_m_s = 5;
  response = forced_response(train);
  EXPECT_EQ(response.rigid_acceleration_rad_s2, 0);
  EXPECT_DOUBLE_EQ(response.speed_offset_rad_s, 4);
  for (int e = 0; e < 3; ++e) EXPECT_NEAR(response.mean_torque_Nm[e], 20, 1e-14);
}

// Frahm's absorber, tuned exactly or almost: the driven mass stands still, wherever it is listed; driven
// itself, the absorber moves the other mass by -M / C. Goes red when a torque is a difference of what a
// resonant subtree makes large.
TEST(TrainClosedForms, TunedAbsorber) {
  for (const bool swapped : {false, true})
    for (const double detuned : {0.0, 1e-15, 1e-12, 1e-9}) {
      auto train = trains::chain({swapped ? 4.0 : 3.0, swapped ? 3.0 : 4.0}, {400});
      const int main = swapped ? 1 : 0, absorber = 1 - main;
      const double M = 5, w = 10 * (1 + detuned), small = detuned + 1e-14;
      train.excitations = {trains::harmonic(train.inertias[main].name, M, w)};
      auto h = forced_response(train).harmonics.at(0);
      EXPECT_NEAR(std::abs(h.angle_rad[main]), 0, small);
      EXPECT_NEAR(h.angle_rad[absorber].real(), -M / 400, small);
      EXPECT_NEAR(h.torque_Nm[0].real(), swapped ? -M : M, 400 * small);
      train.excitations = {trains::harmonic(train.inertias[absorber].name, M, w)};
      h = forced_response(train).harmonics.at(0);
      EXPECT_NEAR(h.angle_rad[main].real(), -M / 400, small);
      EXPECT_NEAR(h.torque_Nm[0].real(), (swapped ? 1 : -1) * 0.75 * M, 400 * small);
    }
}

// A chain whose ends both are tuned to the excitation.
TEST(TrainClosedForms, AbsorbersAtBothEnds) {
  auto train = trains::chain({4, 3, 2, 1}, {400, 70, 100});
  train.excitations = {trains::harmonic("J1", 5, 10)};
  auto h = forced_response(train).harmonics.at(0);
  // Both inner masses stand still, J0 takes the torque of the excitation, J3 none.
  EXPECT_NEAR(h.angle_rad[0].real(), -5.0 / 400, 1e-14);
  for (const int i : {1, 2, 3}) EXPECT_NEAR(std::abs(h.angle_rad[i]), 0, 1e-14) << i;
  // Driven at J0: it needs J1 at -M / 400; J2 stands still, for J3 is tuned; what J1 lacks comes from J0's
  // side.
  train.excitations = {trains::harmonic("J0", 5, 10)};
  h = forced_response(train).harmonics.at(0);
  const double q1 = -5.0 / 400, q0 = q1 * (470 - 300) / 400, q3 = -70 * q1 / 100;
  EXPECT_NEAR(h.angle_rad[0].real(), q0, 1e-14);
  EXPECT_NEAR(h.angle_rad[1].real(), q1, 1e-14);
  EXPECT_NEAR(std::abs(h.angle_rad[2]), 0, 1e-14);
  EXPECT_NEAR(h.angle_rad[3].real(), q3, 1e-14);
}
