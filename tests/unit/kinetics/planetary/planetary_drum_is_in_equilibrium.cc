// Equilibrium of the drum with its charge, from the delivered resultants and from formulas written here once
// more: wrong signs, arms, lost effects and a belt that pulls along the wrong line all leave something over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/planetary/planetary_machines.h"
#include "tests/unit/kinetics/series/moment_sum.h"

namespace {

using Eigen::Vector2d;
using kinetics::LoadHistory;
using kinetics::PlanetaryMill;
using machines::cross;
using machines::Sum;

// Every term carries a few roundings (1e-16 of itself), the sums some ten terms.
constexpr double tolerance = 1e-12;

struct Lengths {
  double carrier, r_O, r_A;
};

Lengths lengths(const PlanetaryMill& mill) {
  if (const auto* given = std::get_if<kinetics::PlanetaryLengths>(&mill.geometry))
    return {given->carrier_m, given->central_pulley_m, given->drum_pulley_m};
  const auto& ratios = std::get<kinetics::PlanetaryRatios>(mill.geometry);
  const double r_A = mill.drum_radius_m / ratios.b;
  return {r_A / ratios.k - r_A, r_A / ratios.c, r_A};
}

struct Charge {
  double mass = 0, distance = 0;
};

/// Mass and centroid of the segment by Gauss-Legendre sums over strips across its axis: t = r cos(theta),
/// width 2 r sin(theta). No formula of the paper in it.
Charge charge(const PlanetaryMill& mill) {
  const double r = mill.drum_radius_m, gamma = *mill.charge.half_angle_rad;
  double area = 0, moment = 0;
  constexpr int n = 64;  // 5-point Gauss-Legendre each: exact to round-off for two circular functions
  const double x[] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640};
  const double w[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                      0.2369268850561891};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 5; ++j) {
      const double theta = gamma * (i + 0.5 + x[j] / 2) / n;
      const double strip = 2 * r * r * std::sin(theta) * std::sin(theta) * gamma / n * w[j] / 2;
      area += strip;
      moment += strip * r * std::cos(theta);
    }
  return {area * mill.charge.bulk_density_kg_m3 * mill.drum_length_m, moment / area};
}

struct Worst {
  double force = 0, moment = 0;
  void note(const Sum& sum) {
    force = std::max(force, sum.force());
    moment = std::max(moment, sum.moment());
  }
};

Vector2d force_of(const LoadHistory& loads, const std::string& role, Eigen::Index i) {
  return loads.resultant(role).total.col(i).head<2>().matrix();
}

Vector2d gravity(const PlanetaryMill& mill, double phi) {
  return -mill.gravity_m_s2 * Vector2d(std::sin(phi), std::cos(phi));
}

/// Masses, strands and bearings as a reader of a drawing would put them on.
Worst drum_with_charge(const PlanetaryMill& mill, const LoadHistory& loads, const Vector2d& about) {
  const Lengths l = lengths(mill);
  const Charge c = charge(mill);
  const double w2 = mill.speed_rad_s * mill.speed_rad_s, alpha = mill.charge.segment_angle_rad;
  const Vector2d A = Vector2d::Zero(), O(-l.carrier, 0),
                 C = c.distance * Vector2d(std::sin(alpha), -std::cos(alpha));
  const double s = (l.r_O - l.r_A) / l.carrier, cosine = std::sqrt(1 - s * s);
  Worst worst;
  for (Eigen::Index i = 0; i < loads.n_instants(); ++i) {
    const Vector2d G = gravity(mill, loads.phi_rad[i]);
    Sum sum(about);
    sum.add(A, mill.drum_mass_kg * (w2 * (A - O) + G));
    sum.add(C, c.mass * (w2 * (C - O) + G));
    for (const double side : {-1.0, 1.0}) {
      const Vector2d normal(s, side * cosine);  // common to both pulleys
      const Vector2d strand = (O + l.r_O * normal) - (A + l.r_A * normal);
      sum.add(A + l.r_A * normal, loads.quantity(side < 0 ? "T1" : "T2").values[i] * strand.normalized());
    }
    sum.add(A, force_of(loads, "trunnions", i));
    worst.note(sum);
  }
  return worst;
}

/// The ports alone: what a body receives.
Worst drum_from_ports(const LoadHistory& loads, const Vector2d& about) {
  Worst worst;
  for (Eigen::Index i = 0; i < loads.n_instants(); ++i) {
    Sum sum(about);
    for (const char* role : {"trunnions", "drum", "inner_wall", "pulley"})
      sum.add(Vector2d::Zero(), force_of(loads, role, i), loads.resultant(role).total(2, i));
    worst.note(sum);
  }
  return worst;
}

void expect_equilibrium(const PlanetaryMill& mill, const LoadHistory& loads) {
  const Vector2d O(-lengths(mill).carrier, 0);
  for (const Vector2d& about : {O, Vector2d(0.7, -0.9)})
    for (const auto& worst : {drum_with_charge(mill, loads, about), drum_from_ports(loads, about)}) {
      EXPECT_LE(worst.force, tolerance);
      EXPECT_LE(worst.moment, tolerance);
    }
  EXPECT_LE(loads.quantity("closure_force").values.maxCoeff(), tolerance);
  EXPECT_LE(loads.quantity("closure_moment").values.maxCoeff(), tolerance);
  EXPECT_EQ((loads.resultant("axle").total + loads.resultant("trunnions").total).abs().maxCoeff(), 0);
}

/// What the carrier and the weights give, the belt takes to the drum and the charge turns into heat: at every
/// instant, and the weights nothing over a turn.
void expect_energy_balance(const PlanetaryMill& mill, const LoadHistory& loads) {
  const auto& carrier_W = loads.quantity("carrier_power").values;
  const auto& gravity_W = loads.quantity("gravity_power").values;
  const auto& belt_W = loads.quantity("belt_power").values;
  const Lengths l = lengths(mill);
  // Friction: the wall slides along a charge that rests in the carrier's frame.
  const Eigen::ArrayXd friction_W =
      -loads.resultant("inner_wall").total.row(2).transpose() * loads.quantity("drum_relative_speed").values;
  const double scale = carrier_W.abs().maxCoeff() + gravity_W.abs().maxCoeff() + belt_W.abs().maxCoeff();
  EXPECT_LE((carrier_W + gravity_W - belt_W).abs().maxCoeff(), tolerance * scale);
  EXPECT_LE((friction_W - belt_W).abs().maxCoeff(), tolerance * scale);
  EXPECT_LE((loads.quantity("charge_power").values - belt_W).abs().maxCoeff(), tolerance * scale);
  EXPECT_LE(std::abs(gravity_W.mean()), tolerance * scale);
  EXPECT_LE(std::abs(carrier_W.mean() - friction_W.mean()), tolerance * scale);
  // Mean torque about O: carrier against the central pulley.
  const double at_pulley_Nm = loads.quantity("belt_difference").values.mean() * l.r_O;
  EXPECT_LE(std::abs(loads.quantity("Y_A").values.mean() * l.carrier - at_pulley_Nm),
            tolerance * scale / mill.speed_rad_s);
}

}  // namespace

TEST(PlanetaryEquilibrium, PrintedMachine) {
  const auto mill = machines::printed_planetary();
  const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 360});
  expect_equilibrium(mill, loads);
  expect_energy_balance(mill, loads);
}

// 1000 machines, because the printed one hides terms: gamma = 90 deg, b = 1, phi0 = 0, c = 1/2.
TEST(PlanetaryEquilibrium, RandomMachines) {
  std::mt19937 generator(20240611);
  for (int k = 0; k < 1000 && !HasFailure(); ++k) {
    SCOPED_TRACE("machine " + std::to_string(k));
    const auto mill = machines::random_planetary(generator);
    const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 12});
    expect_equilibrium(mill, loads);
    expect_energy_balance(mill, loads);
  }
}

// Without the belt the drive couple is all that replaces it: the same check without strands.
TEST(PlanetaryEquilibrium, DriveCoupleReplacesTheBelt) {
  std::mt19937 generator(7);
  for (int k = 0; k < 50; ++k) {
    const auto mill = machines::random_planetary(generator);
    const auto loads = compute_loads(mill, machines::effects_without(mill, {"belt"}), {1, 12});
    const auto& pulley = loads.resultant("pulley");
    EXPECT_EQ(pulley.total.topRows<2>().abs().maxCoeff(), 0);
    ASSERT_EQ(pulley.contributions.size(), 1u);
    EXPECT_EQ(loads.effects[pulley.contributions[0].effect], "drive_couple");
    EXPECT_TRUE((pulley.total.row(2).transpose() == loads.quantity("drive_couple").values).all());
    const Worst worst = drum_from_ports(loads, Vector2d(0.7, -0.9));
    EXPECT_LE(worst.force, tolerance);
    EXPECT_LE(worst.moment, tolerance);
    EXPECT_LE(loads.quantity("closure_moment").values.maxCoeff(), tolerance);
  }
}

// The paper's signs leave over what the documentation says: -2 dT sin(beta) along y, and the moment of the
// weight by which sin(phi) and sin(phi + alpha) differ.
TEST(PlanetaryEquilibrium, AsPublishedLeavesWhatIsDocumented) {
  auto mill = machines::printed_planetary();
  mill.convention = kinetics::PlanetaryConvention::as_published;
  const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 36});
  const double s = 0.1 / 0.9, alpha = mill.charge.segment_angle_rad;
  const Charge c = charge(mill);
  for (Eigen::Index i = 0; i < 36; ++i) {
    const double phi = loads.phi_rad[i];
    double fy = 0, torque = 0;
    for (const char* role : {"trunnions", "drum", "inner_wall", "pulley"}) fy += force_of(loads, role, i).y();
    const auto& wall = loads.resultant("inner_wall");
    for (const auto& part : wall.contributions) {
      const Vector2d C = c.distance * Vector2d(std::sin(alpha), -std::cos(alpha));
      torque += cross(C, part.load.col(i).head<2>().matrix());
    }
    torque += loads.resultant("pulley").total(2, i);
    const double dT = loads.quantity("belt_difference").values[i];
    EXPECT_NEAR(fy, -2 * dT * s, 1e-9);
    EXPECT_NEAR(torque, -c.mass * mill.gravity_m_s2 * c.distance * (std::sin(phi + alpha) - std::sin(phi)),
                1e-9);
  }
  EXPECT_NEAR(loads.quantity("closure_force").values.maxCoeff(), 0.0142, 0.0002);
  EXPECT_NEAR(loads.quantity("closure_moment").values.maxCoeff(), 0.004, 0.0005);
  ASSERT_EQ(loads.warnings.size(), 1u);
  EXPECT_NE(loads.warnings[0].find("do not balance"), std::string::npos);
}
