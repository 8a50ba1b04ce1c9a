/// What effects are worth, on machines whose loads are known by heart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "pipelines/search/effect_choice/effect_report.h"
#include "tests/unit/pipelines/examples/laboratory.h"

using pipelines::EffectWorth;
using pipelines::report_effects;

namespace {

/// One port, forces along x: value = mean + amplitude cos(phi), an effect each.
pipelines::Scene table_scene(const std::vector<std::pair<std::string, kinetics::HarmonicCourse>>& effects) {
  kinetics::LoadTable table;
  table.speed_rad_s = 50;
  pipelines::Scene scene;
  for (const auto& [name, harmonic] : effects) {
    table.loads.push_back({name, "seat", "fx", "N", harmonic});
    scene.effects.push_back(name);
  }
  scene.machine = table;
  scene.sampling = {1, 64};
  return scene;
}

const EffectWorth& worth_of(const pipelines::EffectReport& report, std::string_view name) {
  for (const auto& worth : report.effects)
    if (worth.effect.name == name) return worth;
  throw std::out_of_range(std::string(name));
}

}  // namespace

TEST(EffectWorth, SharesAreThoseOfTheLoad) {
  const auto report = report_effects(table_scene({{"weight", {100, 0}}, {"wave", {0, 25}}}), 0.01, false);
  const auto& wave = worth_of(report, "wave");
  ASSERT_EQ(wave.shares.size(), 1u);
  EXPECT_EQ(wave.shares[0].load, "seat.force");
  EXPECT_NEAR(wave.shares[0].largest, 25.0 / 125, 1e-14);
  EXPECT_NEAR(wave.shares[0].rms, 25 / std::sqrt(2) / std::sqrt(100 * 100 + 25 * 25 / 2.), 1e-14);
  EXPECT_NEAR(wave.if_off, 25.0 / 125, 1e-14);
  EXPECT_EQ(wave.worst_load, "seat.force");
  EXPECT_NEAR(worth_of(report, "weight").if_off, 100.0 / 125, 1e-14);
  EXPECT_TRUE(report.dispensable.empty());
}

// Two of 0.6 % each: one may go below a threshold of 1 %, both together not. Two that cancel: either alone
// would change 50 %, none is offered, although both together would change nothing.
TEST(EffectWorth, WhatCanGoIsJudgedTogether) {
  const auto small =
      report_effects(table_scene({{"big", {1000, 0}}, {"a", {6, 0}}, {"b", {6.1, 0}}}), 0.01, false);
  EXPECT_EQ(small.dispensable, std::vector<std::string>{"a"});
  EXPECT_NEAR(small.if_all_off, 6 / 1012.1, 1e-14);
  const auto both =
      report_effects(table_scene({{"big", {1000, 0}}, {"a", {6, 0}}, {"b", {6.1, 0}}}), 0.02, false);
  EXPECT_EQ(both.dispensable, (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(both.if_all_off, 12.1 / 1012.1, 1e-14);
  const auto cancel =
      report_effects(table_scene({{"big", {10, 0}}, {"push", {5, 0}}, {"pull", {-5, 0}}}), 0.01, false);
  EXPECT_TRUE(cancel.dispensable.empty());
  EXPECT_NEAR(worth_of(cancel, "push").if_off, 0.5, 1e-14);
}

// An axial force is no planar resultant, but a load all the same.
TEST(EffectWorth, LoadsBesideTheResultantsCount) {
  auto scene = table_scene({{"weight", {100, 0}}, {"thrust", {40, 0}}});
  std::get<kinetics::LoadTable>(scene.machine).loads[1].component = "fz";
  const auto report = report_effects(scene, 0.3, false);
  EXPECT_EQ(worth_of(report, "thrust").worst_load, "seat.fz");
  EXPECT_EQ(worth_of(report, "thrust").if_off, 1);
  ASSERT_EQ(worth_of(report, "thrust").shares.size(), 1u);
  EXPECT_EQ(worth_of(report, "thrust").shares[0].largest, 1);
  EXPECT_EQ(worth_of(report, "thrust").shares[0].rms, 1);
  EXPECT_TRUE(report.dispensable.empty());
}

// Two axial forces on one port share it as their sizes do.
TEST(EffectWorth, AxialForcesAreShared) {
  auto scene = table_scene({{"thrust", {30, 0}}, {"wave", {0, 10}}});
  for (auto& load : std::get<kinetics::LoadTable>(scene.machine).loads) load.component = "fz";
  const auto report = report_effects(scene, 0.01, false);
  EXPECT_NEAR(worth_of(report, "thrust").shares.at(0).largest, 30.0 / 40, 1e-14);
  EXPECT_NEAR(worth_of(report, "wave").shares.at(0).largest, 10.0 / 40, 1e-14);
  EXPECT_NEAR(worth_of(report, "wave").shares.at(0).rms, std::sqrt(50.0 / 950), 1e-14);
}

// On the wall the charge's translation has a moment of 1.8 kN at 30 mm, its lag a tenth of that, and gravity,
// made twenty times as strong, more than both: below 60 % the first two can go. The translation cannot go by
// itself, since the lag builds on it.
TEST(EffectWorth, WhatNeedsEachOtherGoesTogether) {
  auto scene = laboratory::scene();
  scene.bodies.clear();
  scene.sampling.instants_per_turn = 24;
  scene.effects = {"gravity_charge", "charge_translation", "charge_coriolis", "charge_lag"};
  auto& mill = std::get<kinetics::VibratoryMill>(scene.machine);
  mill.gravity_m_s2 = 200;
  mill.charge_lag = {0.1, std::nullopt};
  const auto report = report_effects(scene, 0.6, false);
  EXPECT_NE(worth_of(report, "charge_translation").indispensable.find("needs the effect charge_translation"),
            std::string::npos);
  EXPECT_EQ(report.dispensable, (std::vector<std::string>{"charge_lag", "charge_translation"}));
  ASSERT_EQ(report.steps.size(), 2u);
  EXPECT_GT(report.steps[1].if_off, report.steps[0].if_off);
  EXPECT_LT(report.if_all_off, 0.6);
}

TEST(EffectWorth, TheOnlyEffectCannotGo) {
  const auto report = report_effects(table_scene({{"weight", {1, 0}}}), 0.01, false);
  EXPECT_FALSE(worth_of(report, "weight").indispensable.empty());
  EXPECT_TRUE(std::isnan(worth_of(report, "weight").if_off));
}

// In the mill the springs carry the weights at rest: a weight less is a preload less, so the shaft does not
// feel it, while the springs do. And the pitch cannot lose its springs.
TEST(EffectWorth, OfTheLaboratoryMill) {
  auto scene = laboratory::scene();
  scene.sampling.instants_per_turn = 24;
  const auto report = report_effects(scene, 0.01, false);
  EXPECT_EQ(report.effects.size(), scene.kinetics_effects().size());
  for (const auto& share : worth_of(report, "gravity_structure").shares) {
    if (share.load == "eccentric.force") {
      EXPECT_LT(share.if_off, 1e-12);
    }
    if (share.load == "spring_foot_1.force") {
      EXPECT_GT(share.if_off, 0.1);
    }
  }
  EXPECT_NE(worth_of(report, "springs").indispensable, "");
  EXPECT_NE(worth_of(report, "pitch").indispensable, "");  // charge_follows_pitch builds on it
  EXPECT_THROW(report_effects(scene, 0), std::invalid_argument);
  EXPECT_THROW(report_effects(scene, NAN), std::invalid_argument);
}

// Two effects of one part that nearly cancel: the group has their sum, not the sum of their sizes.
TEST(EffectWorth, GroupsAreSums) {
  const auto report = report_effects(
      table_scene({{"charge_coriolis", {-60, 0}}, {"charge_relative", {64, 0}}, {"springs", {16, 0}}}), 0.01,
      false);
  EXPECT_NEAR(worth_of(report, "charge_coriolis").shares.at(0).largest, 3, 1e-14);
  ASSERT_EQ(report.groups.size(), 2u);
  EXPECT_EQ(report.groups[0].name, "inertia of the charge");
  EXPECT_EQ(report.groups[0].effects, (std::vector<std::string>{"charge_coriolis", "charge_relative"}));
  EXPECT_NEAR(report.groups[0].shares.at(0).largest, 4.0 / 20, 1e-14);
  EXPECT_NEAR(report.groups[0].shares.at(0).rms, 4.0 / 20, 1e-14);
  EXPECT_NEAR(report.groups[0].shares.at(0).if_off, 4.0 / 20, 1e-14);
  EXPECT_EQ(report.groups[1].name, "springs");
  EXPECT_NEAR(report.groups[1].shares.at(0).largest, 16.0 / 20, 1e-14);
  const auto alone = report_effects(table_scene({{"weight", {100, 0}}, {"wave", {0, 25}}}), 0.01, false);
  EXPECT_TRUE(alone.groups.empty()) << "they would say nothing that the effects do not";
}

// In the mill the charge's terms are several times the load of the bearings; what the charge brings is not.
TEST(EffectWorth, GroupsOfTheLaboratoryMill) {
  auto scene = laboratory::scene();
  scene.sampling.instants_per_turn = 24;
  const auto report = report_effects(scene, 0.01, false);
  const auto of_bearings = [](const std::vector<pipelines::LoadShare>& shares) {
    for (const auto& share : shares)
      if (share.load == "frame_bearings.force") return share.largest;
    return 0.0;
  };
  std::vector<std::string> names;
  for (const auto& group : report.groups) {
    names.push_back(group.name);
    if (group.name != "inertia of the charge") continue;
    EXPECT_LT(of_bearings(group.shares), 1);
    EXPECT_GT(of_bearings(group.shares), 0.01);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"weights", "inertia of the charge", "inertia of the chamber",
                                             "springs", "debalances"}));
  EXPECT_GT(of_bearings(worth_of(report, "charge_coriolis").shares), 1);
}

// Seconds are measured with what they differ by.
TEST(EffectWorth, TimesHaveARange) {
  auto scene = laboratory::scene();
  scene.sampling.instants_per_turn = 24;
  const auto report = report_effects(scene, 0.01);
  EXPECT_GT(report.per_instant.low_s, 0);
  EXPECT_LE(report.per_instant.low_s, report.per_instant.median_s);
  EXPECT_LE(report.per_instant.median_s, report.per_instant.high_s);
  for (const auto& worth : report.effects) EXPECT_LE(worth.per_instant.low_s, worth.per_instant.high_s);
}
