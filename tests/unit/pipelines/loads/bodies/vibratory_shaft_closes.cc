/// Distribution by statics: what the channels carry is what the load stage said, and the body is in
/// equilibrium. The faults that coupling loads to a turning body invites are each shown to break the check.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/bodies/vibratory_shaft.h"
#include "tests/unit/pipelines/examples/bodies.h"
#include "tests/unit/pipelines/examples/laboratory.h"

namespace {

using bodies::round_off;
using bodies::row;
using pipelines::BodyLoads;
using pipelines::distribute_vibratory_shaft;

pipelines::VibratoryShaftLoading all_on() {
  pipelines::VibratoryShaftLoading options;
  options.own_weight = options.own_inertia = true;
  return options;
}

pipelines::Closure closure_of(const BodyLoads& loads) {
  return bodies::closure_of(loads, laboratory::shaft().regions);
}

TEST(Distribute, ForcesAndMomentsCloseWithOwnMass) {
  const auto loads = distribute_vibratory_shaft(laboratory::spec_loads(), laboratory::shaft(), all_on());
  const auto closure = closure_of(loads);
  EXPECT_LT(closure.worst_force(), round_off);
  EXPECT_LT(closure.worst_moment(), round_off);
  EXPECT_EQ(closure.channel_resultant, 0);
}

TEST(Distribute, ForcesAndMomentsCloseWithoutOwnMass) {
  const auto loads = distribute_vibratory_shaft(laboratory::spec_loads(), laboratory::shaft(), {});
  const auto closure = closure_of(loads);
  EXPECT_LT(closure.worst_force(), round_off);
  EXPECT_LT(closure.worst_moment(), round_off);
  EXPECT_THROW(row(loads, "volume.ax"), std::out_of_range);
}

// coupling.md section 2: R_E from 2.37 to 5.98 kN, 6.11 kN with the shaft's own mass, three figures printed.
TEST(Distribute, BearingsCarryTheSpecsForces) {
  const auto history = laboratory::spec_loads(720);
  const auto loads = distribute_vibratory_shaft(history, laboratory::shaft(), all_on());
  const Eigen::ArrayXd own = loads.frame_bearing_force_N.matrix().colwise().norm();
  EXPECT_NEAR(history.quantity("R_E").values.maxCoeff(), 5980, 5);
  EXPECT_NEAR(history.quantity("R_E").values.minCoeff(), 2370, 5);
  EXPECT_NEAR(own.maxCoeff(), 6110, 5);
  // One bearing carries about half; the coupling overhang makes the halves differ by the weight it adds.
  const Eigen::ArrayXd one = loads.history.values.row(row(loads, "main_bearing_1.fx")).square().transpose() +
                             loads.history.values.row(row(loads, "main_bearing_1.fy")).square().transpose();
  EXPECT_NEAR(std::sqrt(one.maxCoeff()), 3060, 20);
}

// The mill turns clockwise. Turned the other way forces still close, because every force turns alike; the
// moment of B about E does not: 21 N m in the laboratory mill, on a scale of 15.
TEST(Distribute, TurningTheWrongWayFailsByItsMoment) {
  auto history = laboratory::spec_loads();
  history.phi_rad = -history.phi_rad;
  const auto loads = distribute_vibratory_shaft(history, laboratory::shaft(), {});
  const auto closure = closure_of(loads);
  EXPECT_LT(closure.worst_force(), round_off);
  EXPECT_GT(closure.worst_moment(), 0.5);
  // F_eta = F_x sin(phi) + F_y cos(phi) becomes -F_x sin(phi) + F_y cos(phi), at the arm ecc.
  const Eigen::ArrayXd fx = history.resultant("eccentric").total.row(0).transpose();
  const Eigen::ArrayXd sine = history.phi_rad.sin();
  const double wanted = 2 * 0.004 * (fx * sine).abs().maxCoeff();
  EXPECT_NEAR(closure.moment[2] * closure.moment_scale_Nm[2], wanted, 1e-9 * wanted);
  // coupling.md prints 30.8 N m: there the debalances' force turns wrongly at its own arm KE too. Here its
  // moment is a channel of its own, from the fixed frame, that does not turn.
  const Eigen::ArrayXd debalance_fx = history.resultant("debalance").total.row(0).transpose();
  EXPECT_NEAR(2 * ((0.004 * fx + 0.010 * debalance_fx) * sine).abs().maxCoeff(), 30.8, 0.1);
}

// coupling.md: 0.392 N m = m3 g KE.
TEST(Distribute, ForgottenDebalanceTorqueFailsByItsMoment) {
  auto history = laboratory::spec_loads();
  for (auto& resultant : history.resultants)
    if (resultant.role == "debalance")
      for (auto& part : resultant.contributions) part.load.row(2).setZero();
  const auto loads = distribute_vibratory_shaft(history, laboratory::shaft(), {});
  const auto closure = closure_of(loads);
  EXPECT_LT(closure.worst_force(), round_off);
  EXPECT_NEAR(closure.moment[2] * closure.moment_scale_Nm[2], 4 * 9.81 * 0.01, 1e-3);
}

// Gravity turns backwards in a frame that turns clockwise: g (sin phi, -cos phi); a force along e(phi) stands
// still on +xi.
TEST(Distribute, ResolvesAlongTheTurningAxes) {
  const auto history = laboratory::spec_loads();
  const auto loads = distribute_vibratory_shaft(history, laboratory::shaft(), all_on());
  const auto& values = loads.history.values;
  const Eigen::ArrayXd ax = values.row(row(loads, "volume.ax")), ay = values.row(row(loads, "volume.ay"));
  EXPECT_LT((ax - 9.81 * history.phi_rad.sin()).abs().maxCoeff(), 1e-12);
  EXPECT_LT((ay + 9.81 * history.phi_rad.cos()).abs().maxCoeff(), 1e-12);
  const auto& effects = loads.history.effects;
  const auto e =
      std::size_t(std::find(effects.begin(), effects.end(), "debalance_inertia") - effects.begin());
  const Eigen::ArrayXd radial = loads.history.by_effect[e].row(row(loads, "debalance_1.fx"));
  const double wanted = 0.5 * 4 * 0.01 * 151.844 * 151.844;
  EXPECT_LT((radial - wanted).abs().maxCoeff(), 1e-9 * wanted);
  EXPECT_LT(loads.history.by_effect[e].row(row(loads, "debalance_1.fy")).abs().maxCoeff(), 1e-9 * wanted);
}

// The share rule: harmonics are not linear in the effects, their shares still add up to |F| cos(n beta).
TEST(Distribute, PressureSharesAddUp) {
  const auto loads = distribute_vibratory_shaft(laboratory::spec_loads(), laboratory::shaft(), all_on());
  const auto& h = loads.history;
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(h.values.rows(), h.values.cols());
  for (const auto& part : h.by_effect) sum += part;
  EXPECT_LT((sum - h.values).abs().maxCoeff(), 1e-12 * h.values.abs().maxCoeff());
  const Eigen::ArrayXd fx = h.values.row(row(loads, "eccentric_seat.fx")),
                       fy = h.values.row(row(loads, "eccentric_seat.fy"));
  const Eigen::ArrayXd size = (fx.square() + fy.square()).sqrt();
  EXPECT_LT((h.values.row(row(loads, "eccentric_seat.p0c")).transpose() - size).abs().maxCoeff(),
            1e-12 * size.maxCoeff());
  for (const int n : {2, 4}) {
    const auto name = "eccentric_seat.p" + std::to_string(n);
    for (Eigen::Index i = 0; i < size.size(); ++i) {
      const double beta = std::atan2(fy[i], fx[i]) + M_PI;
      EXPECT_NEAR(h.values(row(loads, name + "c"), i), size[i] * std::cos(n * beta), 1e-11 * size.maxCoeff());
      EXPECT_NEAR(h.values(row(loads, name + "s"), i), size[i] * std::sin(n * beta), 1e-11 * size.maxCoeff());
    }
  }
}

// Off is off: the columns of an effect, the channels that only it feeds, and so their unit loads, are gone.
TEST(Distribute, WhatNoEffectFeedsDoesNotExist) {
  const auto names = [](const BodyLoads& loads) {
    std::vector<std::string> result;
    for (const auto& load : loads.unit_loads) result.push_back(load.channel);
    return result;
  };
  const auto history = laboratory::spec_loads();
  const auto full = names(distribute_vibratory_shaft(history, laboratory::shaft(), all_on()));
  // Three pressure seats with fx, fy, p0, p2, p2, p4, p4; two debalances with fx, fy, torque; coupling; ax,
  // ay, spin.
  EXPECT_EQ(full.size(), 3u * 7 + 2 * 3 + 1 + 3);
  EXPECT_EQ(std::count(full.begin(), full.end(), "volume.az"), 0)
      << "steady running has no angular acceleration";

  auto options = all_on();
  options.own_weight = false;
  const auto weightless = names(distribute_vibratory_shaft(history, laboratory::shaft(), options));
  EXPECT_EQ(weightless.size(), full.size() - 2);
  options.own_inertia = false;
  auto body = laboratory::shaft();
  for (const auto& port : body.ports) body.pressures[port.name].highest_harmonic = 0;
  const auto plain = names(distribute_vibratory_shaft(history, body, options));
  EXPECT_EQ(plain.size(), full.size() - 3 - 3 * 4);

  auto machine = laboratory::scene().vibratory_mill();
  const auto only_debalance = kinetics::compute_loads(machine, {"debalance_inertia"}, {20, 24});
  const auto loads = distribute_vibratory_shaft(only_debalance, laboratory::shaft(), {});
  EXPECT_EQ(loads.history.effects, std::vector<std::string>{"debalance_inertia"});
  for (const auto& name : names(loads)) {
    EXPECT_NE(name.substr(0, 14), "eccentric_seat") << name;
    EXPECT_EQ(name.find("torque"), std::string::npos) << name;
  }
  EXPECT_LT(closure_of(loads).worst_force(), round_off);
}

TEST(Distribute, PublishedConventionIsRefused) {
  auto machine = laboratory::scene().vibratory_mill();
  machine.convention = kinetics::Convention::published;
  std::vector<std::string> effects;
  for (const auto& effect : kinetics::vibratory_mill_effects(machine.convention))
    effects.push_back(effect.name);
  const auto history = kinetics::compute_loads(machine, effects, {1, 24});
  EXPECT_THROW(distribute_vibratory_shaft(history, laboratory::shaft(), {}), std::invalid_argument);
}

TEST(Distribute, MissingPortIsNamed) {
  auto body = laboratory::shaft();
  body.ports.erase(body.ports.begin() + 2);
  try {
    distribute_vibratory_shaft(laboratory::spec_loads(), body, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("main_bearing_1"), std::string::npos);
  }
}

}  // namespace
