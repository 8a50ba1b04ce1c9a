// A run of the drive against what was not used to compute it: another integrator, numerical differentiation,
// and the energy of the whole machine.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "kinetics/run_up.h"
#include "kinetics/vibratory_mill.h"

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;
using kinetics::LoadHistory;
using kinetics::VibratoryMill;

VibratoryMill mill() {
  VibratoryMill m;
  m.eccentricity_m = 0.004;
  m.speed_rad_s = 150;
  m.initial_angle_rad = 0.3;
  m.charge_relative_speed_rad_s = -130;
  m.charge_initial_angle_rad = 1.2;
  m.charge_offset_m = 0.03;
  m.charge_mass_kg = 20;
  m.structure_mass_kg = 30;
  m.exciter_mass_kg = 6;
  m.debalance_mass_kg = 4;
  m.debalance_offset_m = 0.01;
  m.chamber_centre_m = {0.28, 0.04};
  m.structure_centre_m = {0.26, 0.02};
  m.pitch_inertia_kg_m2 = 2.85;
  m.springs = {{{0.10, -0.18}, {14000, 27500}, {30, 60}, std::nullopt},
               {{0.46, -0.15}, {9000, 20000}, {20, 50}, std::nullopt}};
  return m;
}

const std::vector<std::string> all{"gravity_structure",
                                   "gravity_exciter",
                                   "gravity_charge",
                                   "gravity_debalance",
                                   "structure_inertia",
                                   "exciter_inertia",
                                   "charge_translation",
                                   "charge_centripetal",
                                   "charge_coriolis",
                                   "charge_relative",
                                   "springs",
                                   "spring_damping",
                                   "debalance_inertia",
                                   "pitch",
                                   "charge_follows_pitch"};

double largest(const ArrayXd& values) {
  return values.abs().maxCoeff();
}

/// Classical Runge-Kutta on I theta'' = M(t) - c theta' - k theta, M of the structure's inertia alone,
/// written out: s'' = ecc (a n(phi) - w^2 e(phi)), l x (-m1 s'').
std::vector<double> reference(const VibratoryMill& m, double acceleration, double k, double c, double end_s,
                              int n_steps, int every) {
  const auto rate = [&](double t, double theta, double theta_dot) {
    const double w = acceleration * t, phi = m.initial_angle_rad + w * t / 2;
    const double ax = m.eccentricity_m * (-acceleration * std::sin(phi) - w * w * std::cos(phi));
    const double ay = m.eccentricity_m * (-acceleration * std::cos(phi) + w * w * std::sin(phi));
    const Vector2d l = m.structure_centre_m;
    const double M = -m.structure_mass_kg * (l.x() * ay - l.y() * ax);
    return (M - c * theta_dot - k * theta) / m.pitch_inertia_kg_m2;
  };
  std::vector<double> out{0};
  const double h = end_s / n_steps;
  double x = 0, v = 0;
  for (int i = 0; i < n_steps; ++i) {
    const double t = i * h;
    const double a1 = rate(t, x, v), v2 = v + h / 2 * a1;
    const double a2 = rate(t + h / 2, x + h / 2 * v, v2), v3 = v + h / 2 * a2;
    const double a3 = rate(t + h / 2, x + h / 2 * v2, v3), v4 = v + h * a3;
    const double a4 = rate(t + h, x + h * v3, v4);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if ((i + 1) % every == 0) out.push_back(x);
  }
  return out;
}

}  // namespace

// Through the pitch's resonance, undamped. The force of the springs' own stretch is cancelled by a spring
// pair that only resists rotation: at +x and -x the stretch s has no moment.
TEST(RunUpLaws, PassageThroughResonanceAgreesWithAnotherIntegrator) {
  auto m = mill();
  const Vector2d ky(0, 20000), none(0, 0);
  m.springs = {{{0.3, 0}, ky, none, none}, {{-0.3, 0}, ky, none, none}};
  const double k = 2 * 20000 * 0.09;  // 35.5 rad/s natural
  const double end_s = 2;
  auto run = kinetics::ramp(0, 100, end_s);
  double error[2];
  const auto exact = reference(m, 50, k, 0, end_s, 80000, 200);
  for (const int fine : {0, 1}) {
    run.steps_per_instant = fine == 0 ? 50 : 100;
    run.step_s = end_s / (400 * run.steps_per_instant) * (1 + 1e-12);
    const auto loads = compute_run_up(m, {"structure_inertia", "springs", "pitch"}, run);
    const ArrayXd& theta = loads.quantity("theta").values;
    ASSERT_EQ(theta.size(), Index(exact.size()));
    const ArrayXd expected = Eigen::Map<const ArrayXd>(exact.data(), Index(exact.size()));
    error[fine] = largest(theta - expected) / largest(expected);
    // Finite, and well above the quasi-static level that it would have without resonance.
    EXPECT_GT(largest(theta), 0.05);
    EXPECT_LT(largest(theta), 0.5);
    EXPECT_NEAR(largest(theta) / largest(expected), 1, 1e-5);
  }
  EXPECT_LT(error[1], 1e-5);
  EXPECT_NEAR(error[0] / error[1], 4, 0.2) << "second order";
}

// The charge's four terms over a run: minus its mass times the second difference of its delivered place.
// Steps h = 1e-4 s, fastest 150 rad/s: (w h)^4 / 90 = 6e-10; round-off 4 eps / (w h)^2 of the place 3e-12 /
// 0.03.
TEST(RunUpLaws, InertiaIsMinusMassTimesAcceleration) {
  const auto m = mill();
  auto run = kinetics::ramp(20, 150, 0.5);
  run.step_s = 1e-4;
  const auto loads = compute_run_up(
      m,
      {"structure_inertia", "charge_translation", "charge_centripetal", "charge_coriolis", "charge_relative"},
      run);
  const Index n = loads.n_instants() - 4;
  ASSERT_GT(n, 4000);
  const double h = loads.time_s[1] - loads.time_s[0];
  const auto second = [&](const ArrayXd& x) -> ArrayXd {
    return (-x.segment(0, n) + 16 * x.segment(1, n) - 30 * x.segment(2, n) + 16 * x.segment(3, n) -
            x.segment(4, n)) /
           (12 * h * h);
  };
  const ArrayXd sx = m.eccentricity_m * loads.phi_rad.cos(), sy = -m.eccentricity_m * loads.phi_rad.sin();
  const auto expect = [&](const ArrayXd& force, const ArrayXd& acceleration, double mass) {
    EXPECT_LE(largest(force.segment(2, n) + mass * acceleration), 1e-8 * largest(force));
  };
  const auto& charge = loads.resultant("inner_wall").total;
  expect(charge.row(0).transpose(), second(sx + loads.quantity("charge_at.x").values), m.charge_mass_kg);
  expect(charge.row(1).transpose(), second(sy + loads.quantity("charge_at.y").values), m.charge_mass_kg);
  for (const auto& part : loads.resultant("eccentric").contributions)
    if (loads.effects[part.effect] == "structure_inertia") {
      expect(part.load.row(0).transpose(), second(sx), m.structure_mass_kg);
      expect(part.load.row(1).transpose(), second(sy), m.structure_mass_kg);
    }
}

// What the drive gives is found again: in the machine's kinetic and potential energy, the dampers and the
// charge. T comes from statics; energies and powers are written out here.
TEST(RunUpLaws, TheDrivePaysForTheMachine) {
  const auto m = mill();
  auto run = kinetics::ramp(0, 150, 1.5);
  run.step_s = 2.5e-5;
  const auto loads = compute_run_up(m, all, run);
  const Index n = loads.n_instants();
  const double g = m.gravity_m_s2;
  ArrayXd energy_J(n);
  const std::vector<Vector2d> preload = [&] {  // at rest: what the springs carry where theta = s = 0
    std::vector<Vector2d> forces;
    auto still = m;
    still.eccentricity_m = 0;
    const auto loads_at_rest =
        compute_loads(still, {"gravity_structure", "gravity_exciter", "gravity_charge", "springs"}, {1, 4});
    for (const char* role : {"spring_foot_1", "spring_foot_2"})
      forces.push_back(loads_at_rest.resultant(role).total.col(0).head<2>().matrix());
    return forces;
  }();
  for (Index i = 0; i < n; ++i) {
    const double phi = loads.phi_rad[i], w = loads.speed_rad_s[i];
    const double theta = loads.quantity("theta").values[i], rate = loads.quantity("theta_dot").values[i];
    const Vector2d e(std::cos(phi), -std::sin(phi)), t(-std::sin(phi), -std::cos(phi));
    const Vector2d s = m.eccentricity_m * e, v = m.eccentricity_m * w * t;
    const Vector2d l = m.structure_centre_m, across(-l.y(), l.x());
    const double own = m.pitch_inertia_kg_m2 - m.structure_mass_kg * l.squaredNorm();
    double sum = 0.5 * m.structure_mass_kg * (v + rate * across).squaredNorm() + 0.5 * own * rate * rate +
                 0.5 * m.exciter_mass_kg * v.squaredNorm() +
                 0.5 * m.debalance_mass_kg * std::pow(m.debalance_offset_m * w, 2) +
                 m.structure_mass_kg * g * (s + theta * across).y() + m.exciter_mass_kg * g * s.y() +
                 m.debalance_mass_kg * g * m.debalance_offset_m * e.y();
    for (std::size_t k = 0; k < m.springs.size(); ++k) {
      const Vector2d p = m.springs[k].position_m, u = s + theta * Vector2d(-p.y(), p.x());
      sum += 0.5 * u.dot(m.springs[k].stiffness_N_m.cwiseProduct(u)) - preload[k].dot(u);
    }
    energy_J[i] = sum;
  }
  const ArrayXd net_W = loads.quantity("drive_power").values - loads.quantity("damping_power").values -
                        loads.quantity("charge_power").values;
  // Trapezoidal sum: (w h)^2 / 12 with twice the drive's 150 rad/s is 5e-6.
  const double h = loads.time_s[1];
  ArrayXd sum_J(n);
  sum_J[0] = 0;
  for (Index i = 1; i < n; ++i) sum_J[i] = sum_J[i - 1] + h * (net_W[i - 1] + net_W[i]) / 2;
  const ArrayXd gained_J = energy_J - energy_J[0];
  EXPECT_GT(largest(gained_J), 10);
  EXPECT_LE(largest(gained_J - sum_J), 1e-5 * largest(gained_J));
}
