#include "kinetics/vibratory/torus_extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using kinetics::Convention;
using kinetics::LoadHistory;
using kinetics::TorusExtremes;
using kinetics::VibratoryMill;
using machines::effects_without;

VibratoryMill incommensurate() {
  auto mill = machines::laboratory();
  mill.charge_relative_speed_rad_s =
      -mill.speed_rad_s * (1 + (std::sqrt(5.0) - 1) / 20);  // golden: ratio -0.06
  return mill;
}

/// Windows lie inside; 1e-12 of the size is round-off of both.
void expect_inside(const LoadHistory& loads, const std::vector<TorusExtremes>& bounds) {
  for (const auto& bound : bounds) {
    const auto& values = loads.quantity(bound.quantity).values;
    ASSERT_TRUE(values.allFinite()) << bound.quantity;
    const double slack = 1e-12 * std::max(std::abs(bound.least.value), std::abs(bound.most.value));
    EXPECT_GE(values.minCoeff(), bound.least.value - slack) << bound.quantity;
    EXPECT_LE(values.maxCoeff(), bound.most.value + slack) << bound.quantity;
  }
}

double gap(const LoadHistory& loads, const TorusExtremes& bound) {
  const auto& values = loads.quantity(bound.quantity).values;
  const double least = values.minCoeff() - bound.least.value, most = bound.most.value - values.maxCoeff();
  return std::max(least, most) / (bound.most.value - bound.least.value);
}

}  // namespace

TEST(TorusExtremes, NamesWhatTheEffectsMake) {
  const auto names = [](const std::vector<TorusExtremes>& all) {
    std::vector<std::string> list;
    for (const auto& one : all) list.push_back(one.quantity);
    return list;
  };
  const auto mill = machines::laboratory();
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(torus_extremes(mill, {"structure_inertia"})), (Names{"theta", "B", "R_E", "T"}));
  EXPECT_EQ(names(torus_extremes(mill, {"springs"})),
            (Names{"theta", "B", "R_E", "T", "spring_1.fx", "spring_1.fy", "spring_2.fx", "spring_2.fy",
                   "spring_force"}));
  EXPECT_EQ(names(torus_extremes(mill, {"springs"}, {"X_E"})), (Names{"X_E"}));
}

// Charge and chamber turn by themselves: at the extremes their forces are parallel or opposite.
TEST(TorusExtremes, ClosedForm) {
  const auto mill = machines::laboratory();
  const auto found = torus_extremes(mill, {"structure_inertia", "charge_relative"}, {"R_E", "X_E"});
  const double structure_N = 30 * 0.004 * std::pow(151.844, 2), charge_N = 20 * 0.03 * std::pow(159.4362, 2);
  EXPECT_NEAR(found[0].most.value / (charge_N + structure_N), 1, 1e-13);
  EXPECT_NEAR(found[0].least.value / (charge_N - structure_N), 1, 1e-13);
  EXPECT_NEAR(found[1].least.value / -(charge_N + structure_N), 1, 1e-13);
  // The forces point along e(phi) and e(chi), the reaction against both: least where both are along +x.
  EXPECT_NEAR(std::cos(found[1].least.phi_rad), 1, 1e-13);
  EXPECT_NEAR(std::cos(found[1].least.chi_rad), 1, 1e-13);
}

// Equal forces cancel at one pair of angles: the magnitude has a cone there, not a flat bottom.
TEST(TorusExtremes, AReactionThatVanishes) {
  auto mill = machines::laboratory();
  mill.structure_mass_kg = 20 * 0.03 * std::pow(159.4362 / 151.844, 2) / 0.004;
  const auto found = torus_extremes(mill, {"structure_inertia", "charge_relative"}, {"R_E"});
  EXPECT_LE(found[0].least.value, 1e-7 * found[0].most.value);  // the step of the angles times the slope
}

TEST(TorusExtremes, EveryWindowLiesInside) {
  std::mt19937 generator(33);
  for (int i = 0; i < 6; ++i) {
    auto mill = i == 0 ? machines::laboratory() : machines::random(generator);
    mill.charge_lag.loss_angle_rad = 0.1;
    const auto effects = effects_without(mill, {});
    expect_inside(compute_loads(mill, effects, {40, 61}), torus_extremes(mill, effects));
  }
  auto published = machines::laboratory();
  published.convention = Convention::published;
  const auto effects = effects_without(published, {});
  expect_inside(compute_loads(published, effects, {20, 61}),
                torus_extremes(published, effects, {"R_E", "X_E", "Y_E", "spring_force_from_moments"}));
}

// Longer windows of a quasi-periodic motion come closer to the bounds, from inside.
TEST(TorusExtremes, LongWindowsApproachThem) {
  const auto mill = incommensurate();
  ASSERT_EQ(period_in_turns(mill), std::nullopt);
  const auto effects = effects_without(mill, {"charge_lag"});
  const auto bounds = torus_extremes(mill, effects);
  const auto brief = compute_loads(mill, effects, {3, 120});
  const auto longer = compute_loads(mill, effects, {300, 120});
  expect_inside(brief, bounds);
  expect_inside(longer, bounds);
  double worst_brief = 0, worst_longer = 0;
  for (const auto& bound : bounds) {
    worst_brief = std::max(worst_brief, gap(brief, bound));
    worst_longer = std::max(worst_longer, gap(longer, bound));
  }
  EXPECT_GT(worst_brief, 0.1);  // in three turns the slow charge has hardly moved
  // What the instants may miss of a second harmonic's crest: (2 pi / 120)^2 / 2 = 1.4e-3 of its amplitude.
  EXPECT_LT(worst_longer, 1.4e-3);
}

// 1e4 turns: the angles grow to 6e4 rad and their rounding to 1e-11, no more.
TEST(TorusExtremes, TenThousandTurns) {
  const auto mill = incommensurate();
  const std::vector<std::string> effects{"gravity_charge",
                                         "structure_inertia",
                                         "charge_translation",
                                         "charge_centripetal",
                                         "charge_coriolis",
                                         "charge_relative",
                                         "springs",
                                         "pitch"};
  const auto loads = compute_loads(mill, effects, {10000, 5});
  for (const auto& quantity : loads.quantities) EXPECT_TRUE(quantity.values.allFinite()) << quantity.name;
  EXPECT_LE(machines::largest(loads.quantity("closure_moment").values), 1e-12);
  const auto bounds = torus_extremes(mill, effects);
  expect_inside(loads, bounds);
  for (const auto& bound : bounds) EXPECT_LT(gap(loads, bound), 0.2) << bound.quantity;  // 1 - cos(pi / 5)
}

TEST(TorusExtremes, WrongInputIsRefused) {
  const auto refusal = [](const std::string& name, Convention convention) -> std::string {
    auto mill = machines::laboratory();
    mill.convention = convention;
    try {
      torus_extremes(mill, {"springs", "gravity_charge"}, {name});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal("R_e", Convention::consistent).find("did you mean R_E"), std::string::npos);
  EXPECT_NE(refusal("chi", Convention::consistent).find("no extremes"), std::string::npos);
  EXPECT_NE(refusal("K_star", Convention::published).find("no extremes"), std::string::npos);
  EXPECT_THROW(torus_extremes(machines::laboratory(), {"sprigns"}), std::invalid_argument);
}
