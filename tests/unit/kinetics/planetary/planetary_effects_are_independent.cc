// Effects that are off are not evaluated; those that are on keep their own share, and shares add up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "kinetics/planetary/balance.h"
#include "tests/unit/kinetics/planetary/planetary_machines.h"
#include "tests/unit/kinetics/values/whole_history.h"

namespace {

using kinetics::LoadHistory;
using kinetics::PlanetaryConvention;
using kinetics::PlanetaryMill;
using machines::effects_without;

const kinetics::TimeGrid one_turn{1, 36};
const PlanetaryConvention conventions[] = {PlanetaryConvention::as_published, PlanetaryConvention::as_plotted,
                                           PlanetaryConvention::consistent};

PlanetaryMill printed(PlanetaryConvention convention = PlanetaryConvention::consistent) {
  auto mill = machines::printed_planetary();
  mill.convention = convention;
  return mill;
}

std::set<std::string> contributing(const LoadHistory& loads) {
  std::set<std::string> names;
  for (const auto& resultant : loads.resultants)
    for (const auto& part : resultant.contributions) names.insert(loads.effects[part.effect]);
  return names;
}

}  // namespace

// Goes red when the balance evaluates an effect for its own purposes, or more often than needed.
TEST(PlanetaryEffects, OnlyNamedEffectsAreEvaluatedAndOncePerBlock) {
  const std::vector<std::string> names{"charge_transport", "drum_gravity", "belt"};
  std::map<std::string, int> count;
  const auto machine = kinetics::planetary::make_machine(printed());
  auto effects = make_effects(machine, {"belt", "charge_transport", "drum_gravity"});
  for (auto& effect : effects)
    effect.evaluate = [&count, name = effect.name,
                       inner = effect.evaluate](const kinetics::planetary::Instants& at) {
      ++count[name];
      return inner(at);
    };
  const auto loads = balance(machine, effects, {1, 600});  // three blocks of up to 256 instants
  EXPECT_EQ(count, (std::map<std::string, int>{{"charge_transport", 3}, {"drum_gravity", 3}, {"belt", 3}}));
  EXPECT_EQ(loads.effects, names);
  EXPECT_EQ(contributing(loads), std::set<std::string>(names.begin(), names.end()));
}

TEST(PlanetaryEffects, EachAloneContributesAloneAndIsFinite) {
  for (const auto convention : conventions)
    for (const auto& info : kinetics::planetary_mill_effects(convention)) {
      SCOPED_TRACE(info.name);
      const auto loads = compute_loads(printed(convention), {info.name}, one_turn);
      auto expected = std::set<std::string>{info.name};
      if (info.name.rfind("charge_", 0) == 0) expected.insert("drive_couple");
      EXPECT_EQ(contributing(loads), expected);
      machines::expect_whole(loads, 36);
      EXPECT_FALSE(info.description.empty() || info.source.empty());
    }
}

// All but the belt are independent of each other: single runs add up. The belt answers to the charge's
// moment; it is the difference that it makes to a run with all the others.
TEST(PlanetaryEffects, SingleRunsAddUpToAll) {
  for (const auto convention : conventions) {
    const auto mill = printed(convention);
    const auto all = compute_loads(mill, effects_without(mill, {}), one_turn);
    Eigen::Array3Xd sum = Eigen::Array3Xd::Zero(3, 36);
    for (const auto& name : effects_without(mill, {"belt"}))
      sum += compute_loads(mill, {name}, one_turn).resultant("axle").total;
    const auto without = compute_loads(mill, effects_without(mill, {"belt"}), one_turn);
    const double scale = all.quantity("R_A").values.maxCoeff();
    EXPECT_LE((sum - without.resultant("axle").total).abs().maxCoeff(), 1e-15 * scale);
    const auto& belt = all.resultant("axle").contributions.back();
    ASSERT_EQ(all.effects[belt.effect], "belt");
    EXPECT_LE((sum + belt.load - all.resultant("axle").total).abs().maxCoeff(), 1e-15 * scale);
    // A ratio belt that keeps its strands is linear in the moment.
    const auto inertia = compute_loads(mill, {"charge_transport", "belt"}, one_turn);
    if (convention != PlanetaryConvention::consistent) {
      const auto weight = compute_loads(mill, {"charge_gravity", "belt"}, one_turn);
      EXPECT_LE((inertia.resultant("pulley").total + weight.resultant("pulley").total - belt.load)
                    .row(0)
                    .abs()
                    .maxCoeff(),
                1e-15 * scale);
    }
  }
}

TEST(PlanetaryEffects, SwitchingOneOffLeavesTheOthersShares) {
  for (const auto convention : conventions) {
    const auto mill = printed(convention);
    const auto all = compute_loads(mill, effects_without(mill, {}), one_turn);
    for (const auto& off : effects_without(mill, {})) {
      const auto fewer = compute_loads(mill, effects_without(mill, {off}), one_turn);
      EXPECT_EQ(contributing(fewer).count(off), 0u);
      for (const auto& resultant : fewer.resultants)
        for (const auto& part : resultant.contributions)
          if (const std::string& effect = fewer.effects[part.effect];
              effect != "belt" && effect != "drive_couple")
            for (const auto& other : all.resultant(resultant.role).contributions)
              if (all.effects[other.effect] == effect) {
                EXPECT_TRUE((other.load == part.load).all()) << resultant.role << " " << effect;
              }
    }
  }
}

// A load role is there exactly if an effect loads it; axle and trunnions are always there.
TEST(PlanetaryEffects, RolesFollowTheEffects) {
  const auto roles = [](const std::vector<std::string>& effects) {
    std::vector<std::string> names;
    for (const auto& r : compute_loads(printed(), effects, one_turn).resultants) names.push_back(r.role);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(roles({}), (Names{"axle", "trunnions"}));
  EXPECT_EQ(roles({"drum_gravity"}), (Names{"axle", "trunnions", "drum"}));
  EXPECT_EQ(roles({"charge_gravity"}), (Names{"axle", "trunnions", "inner_wall", "pulley"}));
  EXPECT_EQ(roles({"belt", "drum_transport"}), (Names{"axle", "trunnions", "drum", "pulley"}));
}

TEST(PlanetaryEffects, ContributionsAddUpToTotals) {
  std::mt19937 generator(11);
  for (int k = 0; k < 20; ++k) {
    const auto mill = machines::random_planetary(generator);
    const auto loads = compute_loads(mill, effects_without(mill, {}), one_turn);
    for (const auto& resultant : loads.resultants) {
      Eigen::Array3Xd sum = Eigen::Array3Xd::Zero(3, loads.n_instants());
      double scale = 0;
      for (const auto& part : resultant.contributions) {
        sum += part.load;
        scale = std::max(scale, part.load.abs().maxCoeff());
      }
      EXPECT_LE((sum - resultant.total).abs().maxCoeff(), 1e-14 * scale) << resultant.role;
    }
  }
}

// Instants that belong to several grids: blocks and their borders must not show.
TEST(PlanetaryEffects, AnInstantDoesNotDependOnTheGrid) {
  const auto names = effects_without(printed(), {});
  const auto coarse = compute_loads(printed(), names, one_turn);
  const auto fine = compute_loads(printed(), names, {1, 36 * 20});
  for (const auto& quantity : coarse.quantities) {
    if (quantity.unit == "1") continue;  // round-off
    const auto& values = fine.quantity(quantity.name).values;
    for (Eigen::Index i = 0; i < 36; ++i)
      EXPECT_NEAR(values[20 * i], quantity.values[i], 1e-13 * quantity.values.abs().maxCoeff())
          << quantity.name;
  }
}

// The order in which a scene names effects must not change a bit of the result.
TEST(PlanetaryEffects, OrderOfNamingDoesNotMatter) {
  auto names = effects_without(printed(), {});
  const auto forward = compute_loads(printed(), names, one_turn);
  std::reverse(names.begin(), names.end());
  const auto backward = compute_loads(printed(), names, one_turn);
  EXPECT_EQ(forward.effects, backward.effects);
  for (const auto& quantity : forward.quantities)
    EXPECT_TRUE((quantity.values == backward.quantity(quantity.name).values).all()) << quantity.name;
}

TEST(PlanetaryEffects, OffsetIsTheConsistentName) {
  EXPECT_EQ(kinetics::planetary_mill_effects(PlanetaryConvention::consistent)[2].name, "charge_offset");
  EXPECT_EQ(kinetics::planetary_mill_effects(PlanetaryConvention::as_plotted)[2].name, "charge_relative");
}
