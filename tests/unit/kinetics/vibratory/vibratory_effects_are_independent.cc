// Effects that are off are not evaluated; those that are on keep their own share, and shares add up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "kinetics/vibratory/balance.h"
#include "kinetics/vibratory/published.h"
#include "kinetics/vibratory/table.h"
#include "tests/unit/kinetics/values/whole_history.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using kinetics::Convention;
using kinetics::LoadHistory;
using kinetics::VibratoryMill;
using machines::effects_without;
using machines::largest;

const kinetics::TimeGrid one_turn{1, 36};

VibratoryMill mill() {
  auto m = machines::laboratory();
  m.charge_lag.loss_angle_rad = 0.2;
  return m;
}

/// The effects with a counter round each.
std::vector<kinetics::vibratory::NamedEffect> counted(const VibratoryMill& m,
                                                      const std::vector<std::string>& names,
                                                      std::map<std::string, int>& count) {
  auto effects = kinetics::vibratory::make_effects(m, names);
  for (auto& effect : effects)
    effect.evaluate = [&count, name = effect.name,
                       inner = effect.evaluate](const kinetics::vibratory::Instants& at) {
      ++count[name];
      return inner(at);
    };
  return effects;
}

std::set<std::string> contributing(const LoadHistory& loads) {
  std::set<std::string> names;
  for (const auto& resultant : loads.resultants)
    for (const auto& part : resultant.contributions) names.insert(loads.effects[part.effect]);
  return names;
}

/// An effect with those it needs.
std::vector<std::string> with_base(Convention convention, const std::string& effect) {
  std::vector<std::string> names{effect};
  for (std::size_t i = 0; i < names.size(); ++i)
    for (const auto& open : open_needs(kinetics::vibratory_mill_effects(convention), names))
      names.push_back(open.need.effect);
  return names;
}

}  // namespace

// Goes red when the balance evaluates an effect for its own purposes, or more often than needed.
TEST(VibratoryEffects, OnlyNamedEffectsAreEvaluatedAndOncePerBlock) {
  const std::vector<std::string> names{"gravity_charge", "springs", "debalance_inertia"};
  std::map<std::string, int> count;
  const auto loads =
      balance(mill(), counted(mill(), names, count), {1, 600});  // three blocks of up to 256 instants
  EXPECT_EQ(count,
            (std::map<std::string, int>{{"gravity_charge", 3}, {"springs", 3}, {"debalance_inertia", 3}}));
  EXPECT_EQ(loads.effects, names);
  EXPECT_EQ(contributing(loads), std::set<std::string>(names.begin(), names.end()));
  EXPECT_FALSE(loads.has_resultant("spring_foot_3"));
}

TEST(VibratoryEffects, PitchCostsOneMoreEvaluation) {
  const std::vector<std::string> names{"structure_inertia", "springs", "pitch"};
  std::map<std::string, int> count;
  balance(mill(), counted(mill(), names, count), {1, 600});
  EXPECT_EQ(count, (std::map<std::string, int>{{"structure_inertia", 4}, {"springs", 4}, {"pitch", 4}}));
}

TEST(VibratoryEffects, EachAloneContributesAloneAndIsFinite) {
  for (const auto convention : {Convention::consistent, Convention::published})
    for (const auto& info : kinetics::vibratory_mill_effects(convention)) {
      SCOPED_TRACE(info.name);
      auto m = mill();
      m.convention = convention;
      const auto names = with_base(convention, info.name);
      const auto loads = compute_loads(m, names, one_turn);
      EXPECT_EQ(contributing(loads), std::set<std::string>(names.begin(), names.end()));
      machines::expect_whole(loads, 36);
      EXPECT_FALSE(info.description.empty() || info.source.empty());
    }
}

// A load role is there exactly if an effect loads it; the joints are always there.
TEST(VibratoryEffects, RolesFollowTheEffects) {
  const auto roles = [](const std::vector<std::string>& effects) {
    std::vector<std::string> names;
    for (const auto& r : compute_loads(mill(), effects, one_turn).resultants) names.push_back(r.role);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(roles({"structure_inertia"}), (Names{"eccentric", "frame_bearings", "drive", "housing_bore"}));
  EXPECT_EQ(roles({"gravity_debalance"}),
            (Names{"eccentric", "debalance", "frame_bearings", "drive", "housing_bore"}));
  EXPECT_EQ(roles({"gravity_charge", "springs"}),
            (Names{"eccentric", "frame_bearings", "drive", "housing_bore", "inner_wall", "spring_foot_1",
                   "spring_foot_2"}));
}

TEST(VibratoryEffects, ContributionsAddUpToTotals) {
  const auto loads = compute_loads(mill(), effects_without(mill(), {}), one_turn);
  for (const auto& resultant : loads.resultants) {
    Eigen::Array3Xd sum = Eigen::Array3Xd::Zero(3, loads.n_instants());
    double scale = 0;
    for (const auto& part : resultant.contributions) {
      sum += part.load;
      scale = std::max(scale, part.load.abs().maxCoeff());
    }
    // Contributions cancel each other (Coriolis 29 kN against 14 and 15 kN); round-off is that of the
    // largest.
    EXPECT_LE((sum - resultant.total).abs().maxCoeff(), 1e-14 * scale) << resultant.role;
  }
}

// With the pitch held the mill is linear: an effect's share does not depend on which others are on.
TEST(VibratoryEffects, SwitchingOneOffLeavesTheOthersShares) {
  const auto all =
      compute_loads(mill(), effects_without(mill(), {"pitch", "charge_follows_pitch"}), one_turn);
  const auto fewer = compute_loads(
      mill(), effects_without(mill(), {"pitch", "charge_follows_pitch", "charge_coriolis"}), one_turn);
  for (const auto& resultant : fewer.resultants)
    for (const auto& part : resultant.contributions)
      for (const auto& other : all.resultant(resultant.role).contributions)
        if (const std::string& effect = fewer.effects[part.effect]; all.effects[other.effect] == effect) {
          EXPECT_TRUE((other.load == part.load).all()) << resultant.role << " " << effect;
        }
}

// Instants that belong to several grids: blocks and their borders must not show.
TEST(VibratoryEffects, AnInstantDoesNotDependOnTheGrid) {
  const auto names = effects_without(mill(), {});
  const auto coarse = compute_loads(mill(), names, one_turn);
  const auto fine = compute_loads(mill(), names, {1, 36 * 20});
  for (const auto& quantity : coarse.quantities) {
    if (quantity.name == "moment_residual" || quantity.unit == "1") continue;  // round-off
    const auto& values = fine.quantity(quantity.name).values;
    for (Eigen::Index i = 0; i < 36; ++i)
      // phi itself is rounded differently: 1e-15 of it, times the loads' slope.
      EXPECT_NEAR(values[20 * i], quantity.values[i], 1e-12 * largest(quantity.values)) << quantity.name;
  }
}

// The order in which a scene names effects must not change a bit of the result.
TEST(VibratoryEffects, OrderOfNamingDoesNotMatter) {
  auto names = effects_without(mill(), {});
  const auto forward = compute_loads(mill(), names, one_turn);
  std::reverse(names.begin(), names.end());
  const auto backward = compute_loads(mill(), names, one_turn);
  EXPECT_EQ(forward.effects, backward.effects);
  for (const auto& quantity : forward.quantities)
    EXPECT_TRUE((quantity.values == backward.quantity(quantity.name).values).all()) << quantity.name;
}

// Without eccentricity, charge and debalance offset nothing accelerates: only weights and preload are left.
TEST(VibratoryEffects, InertiaIsPassiveAtRest) {
  auto m = mill();
  m.eccentricity_m = m.charge_offset_m = m.debalance_offset_m = 0;
  const auto loads = compute_loads(m, effects_without(m, {}), one_turn);
  for (const auto& resultant : loads.resultants)
    for (const auto& part : resultant.contributions)
      if (const std::string& effect = loads.effects[part.effect];
          effect != "springs" && effect.rfind("gravity", 0) != 0) {
        // The pitch answers to what is left of the static balance of the moments, round-off of about 1e-14 N
        // m.
        EXPECT_LE(part.load.abs().maxCoeff(), 1e-9) << resultant.role << " " << effect;
      }
}
