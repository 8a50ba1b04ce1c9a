// Inertia forces against the numerically differentiated motion, in a motion that speeds up and slows down, so
// that the terms with phi'' and omega_r' count too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "kinetics/vibratory_effects/effect.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::Vector2d;
using kinetics::VibratoryMill;
using kinetics::vibratory::Effect;
using kinetics::vibratory::Instants;

// An arbitrary unsteady motion with closed derivatives.
double phi(double t) {
  return 0.3 + 150 * t + 0.7 * std::sin(40 * t);
}
double phi_dot(double t) {
  return 150 + 28 * std::cos(40 * t);
}
double phi_ddot(double t) {
  return -1120 * std::sin(40 * t);
}
double chi(double t) {
  return 1.1 - 8 * t + 0.5 * std::cos(60 * t);
}
double chi_dot(double t) {
  return -8 - 30 * std::sin(60 * t);
}
double chi_ddot(double t) {
  return -1800 * std::cos(60 * t);
}

Vector2d e(double a) {
  return {std::cos(a), -std::sin(a)};
}

Eigen::ArrayXd one(double value) {
  return Eigen::ArrayXd::Constant(1, value);
}

Instants at(double t) {
  return {one(phi(t)),
          one(chi(t)),
          one(phi_dot(t)),
          one(phi_ddot(t)),
          one(chi_dot(t) - phi_dot(t)),
          one(chi_ddot(t) - phi_ddot(t)),
          one(0),
          one(0),
          one(0)};
}

Vector2d force(const std::vector<Effect>& effects, double t) {
  Vector2d sum = Vector2d::Zero();
  for (const Effect& effect : effects)
    for (const auto& placed : effect(at(t))) sum += placed.force_N.col(0).matrix();
  return sum;
}

/// Second derivative by five points. With h = 5e-5 s the fastest part of the motion advances by w h = 0.009
/// per step: the method's error is (w h)^4 / 90 = 7e-11 and round-off 4 eps / (w h)^2 = 1e-11 of the
/// acceleration.
Vector2d acceleration(const std::function<Vector2d(double)>& x, double t) {
  constexpr double h = 5e-5;
  return (-x(t - 2 * h) + 16 * x(t - h) - 30 * x(t) + 16 * x(t + h) - x(t + 2 * h)) / (12 * h * h);
}

void expect_inertia(double mass_kg, const std::function<Vector2d(double)>& x,
                    const std::vector<Effect>& effects) {
  double worst = 0, scale = 0;
  for (double t = 0; t < 0.3; t += 0.0071) {
    const Vector2d expected = -mass_kg * acceleration(x, t);
    worst = std::max(worst, (force(effects, t) - expected).norm());
    scale = std::max(scale, expected.norm());
  }
  EXPECT_LE(worst, 1e-9 * scale);  // ten times the error of the differences above
  ::testing::Test::RecordProperty("deviation_e-12", std::to_string(worst / scale * 1e12));
}

VibratoryMill mill() {
  auto m = machines::laboratory();
  m.charge_lag.loss_angle_rad = 0.3;
  return m;
}

}  // namespace

TEST(VibratoryInertia, Charge) {
  const auto m = mill();
  using namespace kinetics::vibratory;
  const auto centre = [&](double t) -> Vector2d {
    return m.eccentricity_m * e(phi(t)) + m.charge_offset_m * e(chi(t));
  };
  expect_inertia(m.charge_mass_kg, centre,
                 {charge_translation(m), charge_centripetal(m), charge_coriolis(m), charge_relative(m)});
}

TEST(VibratoryInertia, ChargeThatLags) {
  const auto m = mill();
  using namespace kinetics::vibratory;
  const auto centre = [&](double t) -> Vector2d {
    return m.eccentricity_m * e(phi(t) - 0.3) + m.charge_offset_m * e(chi(t));
  };
  expect_inertia(
      m.charge_mass_kg, centre,
      {charge_translation(m), charge_centripetal(m), charge_coriolis(m), charge_relative(m), charge_lag(m)});
}

TEST(VibratoryInertia, StructureAndExciter) {
  const auto m = mill();
  const auto centre = [&](double t) -> Vector2d { return m.eccentricity_m * e(phi(t)); };
  expect_inertia(m.structure_mass_kg, centre, {kinetics::vibratory::structure_inertia(m)});
  expect_inertia(m.exciter_mass_kg, centre, {kinetics::vibratory::exciter_inertia(m)});
}

TEST(VibratoryInertia, Debalance) {
  const auto m = mill();
  const auto centre = [&](double t) -> Vector2d { return m.debalance_offset_m * e(phi(t)); };
  expect_inertia(m.debalance_mass_kg, centre, {kinetics::vibratory::debalance_inertia(m)});
}
