/// effects = "auto" without a mesh: how it is read, and what it switches off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/search/effect_choice/effect_bounds.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "tests/unit/pipelines/examples/bodies.h"
#include "tests/unit/pipelines/examples/plain_body.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

namespace {

using Names = std::vector<std::string>;

std::set<std::string> sorted(const Names& names) {
  return {names.begin(), names.end()};
}

/// A shipped scene with another value of `effects`.
Scene scene_with(const std::string& name, const std::string& value) {
  const results_test::Directory at;
  const auto scenes = std::filesystem::path(SOURCE_DIR) / "pipelines/scenes";
  std::filesystem::copy(scenes / "belt_pull.csv", at / "belt_pull.csv");
  std::string text = results_test::bytes(scenes / (name + ".toml"));
  const auto begin = text.find("effects = ["), end = text.find(']', begin);
  text.replace(begin, end + 1 - begin, "effects = " + value);
  std::ofstream(at / "scene.toml", std::ios::binary) << text;
  return read_scene(at / "scene.toml");
}

/// The laboratory mill with its shaft alone and few instants, its effects to be chosen.
Scene shaft_scene() {
  Scene scene = scene_with("vibratory_mill", "\"auto\"");
  scene.bodies.erase(std::remove_if(scene.bodies.begin(), scene.bodies.end(),
                                    [](const auto& body) { return body.name != "shaft"; }),
                     scene.bodies.end());
  scene.sampling.instants_per_turn = 24;
  return scene;
}

Scene chosen(const Scene& scene, double limit) {
  return with_effects_chosen(scene, {plain::meshed(scene.bodies.front())}, limit);
}

Names dropped(const Scene& scene) {
  Names names;
  for (const auto& effect : scene.effect_choice.dropped) names.push_back(effect.effect);
  return names;
}

/// A bar with two seats at z = -1 and 2 m.
LoadedBody bar() {
  return {"bar",
          {bodies::port("left", meshes::Port::Kind::seat, 1, {-1.1, -0.9}, 0.1),
           bodies::port("right", meshes::Port::Kind::seat, 2, {1.9, 2.1}, 0.1)},
          {{"", {}, {0, 10, {0, 0, 5}, {0.02, 0.03, 40, 0, 0, 0}}}},
          {}};
}

Eigen::Array2Xd along_x(double force_N) {
  Eigen::Array2Xd force = Eigen::Array2Xd::Zero(2, 2);
  force(0, 1) = force_N;
  return force;
}

/// Forces along x on both seats, at the second of two instants.
BodyLoads forces(double left_N, double right_N) {
  const auto body = bar();
  LoadCollector collector(body, {"a"}, 2, 1);
  collector.force("left", 0, along_x(left_N));
  collector.force("right", 0, along_x(right_N));
  return collector.finish();
}

}  // namespace

// Forces 40 and 10 N at levers of 1 and 2 m: a change of 3 N on the right is 3/50 of the forces and 6/60 of
// the moments; the whole right one is 10/50 and 20/60.
TEST(ShareOfLoads, IsTheLargerOfForcesAndMoments) {
  const auto all = forces(40, 10);
  EXPECT_NEAR(share_of_loads(all, forces(40, 13), bar().regions), 6.0 / 60, 1e-14);
  EXPECT_NEAR(share_of_loads(all, forces(34, 10), bar().regions), 6.0 / 50, 1e-14);
  EXPECT_NEAR(share_of_loads(all, forces(40, 0), bar().regions), 20.0 / 60, 1e-14);
  // A channel that only the other one has counts as well.
  EXPECT_NEAR(share_of_loads(forces(40, 0), all, bar().regions), 20.0 / 40, 1e-14);
  EXPECT_EQ(share_of_loads(all, all, bar().regions), 0);
  EXPECT_TRUE(std::isinf(share_of_loads(forces(0, 0), all, bar().regions)));
}

// The centrifugal field of a bar about its axis has no resultant. Its forces add up to at most sqrt(m J) per
// rad2/s2; weight counts with the mass, rotation with the inertia.
TEST(ShareOfLoads, BodyForcesCountWithMassAndInertia) {
  const auto body = bar();
  const auto size = [&](fem::BodyForce::Field field) {
    return size_of_unit({"volume.x", fem::BodyForce{field, {}}}, body.regions);
  };
  EXPECT_NEAR(size(fem::BodyForce::Field::spin).force, std::sqrt(10 * 0.05), 1e-14);
  EXPECT_NEAR(size(fem::BodyForce::Field::translation_x).force, 10, 1e-14);
  EXPECT_NEAR(size(fem::BodyForce::Field::translation_x).moment, 5, 1e-14);  // first moment in z
  EXPECT_NEAR(size(fem::BodyForce::Field::rotation).moment, 0.05, 1e-14);
  EXPECT_EQ(size(fem::BodyForce::Field::rotation).force, 0);
}

// The list of every shipped scene is all that it has data for, but for the root peeler's train, which lists
// its dampings no more than its torques.
TEST(EffectChoice, AllIsWhatTheSceneHasDataFor) {
  for (const std::string name : {"vibratory_mill", "planetary_mill", "stub_axle", "load_table"}) {
    const Scene all = scene_with(name, "\"all\"");
    EXPECT_EQ(sorted(all.effects), sorted(plain::scene(name).effects)) << name;
    EXPECT_FALSE(all.effect_choice.open) << name;
    const Scene open = scene_with(name, "\"auto\"");
    EXPECT_EQ(open.effects, all.effects) << name;
    EXPECT_TRUE(open.effect_choice.open) << name;
  }
  for (const std::string name : {"drive_train", "root_peeler_shaft"}) {
    const auto all = sorted(scene_with(name, "\"all\"").effects);
    for (const auto& effect : plain::scene(name).effects) EXPECT_EQ(all.count(effect), 1u) << effect;
  }
}

// What can go is judged against the limit: just below the next effect's share it stays, just above it goes.
TEST(EffectChoice, TheThresholdDecides) {
  const Scene scene = shaft_scene();
  const auto least = chosen(scene, 1e-9);
  // Weights that the springs carry at rest do not reach the shaft; the charge's moves with the charge.
  EXPECT_EQ(sorted(dropped(least)), (std::set<std::string>{"gravity_structure", "gravity_exciter"}));
  EXPECT_LT(least.effect_choice.share, 1e-9);
  // The next one by its own share.
  const auto more = chosen(scene, 0.05);
  ASSERT_GT(more.effect_choice.dropped.size(), 2u);
  const auto next = more.effect_choice.dropped[2];
  for (const double slack : {-1e-6, 1e-6}) {
    const auto names = dropped(chosen(scene, next.share * (1 + slack)));
    EXPECT_EQ(std::count(names.begin(), names.end(), next.effect), slack > 0 ? 1 : 0) << slack;
  }
  // Together they stay below the limit, too.
  EXPECT_LT(more.effect_choice.share, 0.05);
  EXPECT_GT(more.effect_choice.share, next.share);
  EXPECT_EQ(more.effects.size() + more.effect_choice.dropped.size(), scene.effects.size());
  // A limit that each of them keeps, but not all together: others go.
  const double tight = more.effect_choice.share * (1 - 1e-6);
  for (const auto& effect : more.effect_choice.dropped) ASSERT_LT(effect.share, tight) << effect.effect;
  EXPECT_LT(chosen(scene, tight).effect_choice.share, tight);
}

// Once chosen it stays so, and the same each time: no clock takes part.
TEST(EffectChoice, IsTheSameEachTime) {
  const Scene scene = shaft_scene();
  const Scene first = chosen(scene, 0.05);
  EXPECT_EQ(dropped(chosen(scene, 0.05)), dropped(first));
  EXPECT_EQ(chosen(first, 0.5).effects, first.effects);
}

// The spring's weights change a bearing whose life is asked for only through R_E, which they do not reach.
// A bearing on a spring would keep them.
TEST(EffectChoice, BearingsThatAreAskedForKeepTheirLoads) {
  Scene scene = shaft_scene();
  EXPECT_EQ(chosen(scene, 0.005).has_effect("gravity_structure"), false);
  scene.bearings.push_back(scene.bearings.front());
  scene.bearings.back().load = "spring_foot_1";
  EXPECT_EQ(chosen(scene, 0.005).has_effect("gravity_structure"), true);
}

// An effect that comes back takes its old place, and is noted.
TEST(EffectChoice, TakenBackEffectsReturnToTheirPlace) {
  const Scene scene = shaft_scene();
  const Scene without = chosen(scene, 0.005);
  ASSERT_FALSE(without.has_effect("gravity_exciter"));
  const Scene back = with_effect_back(without, "gravity_exciter");
  Names wanted;
  for (const auto& effect : scene.effects)
    if (effect == "gravity_exciter" || without.has_effect(effect)) wanted.push_back(effect);
  EXPECT_EQ(back.effects, wanted);
  EXPECT_EQ(back.effect_choice.taken_back, Names{"gravity_exciter"});
  EXPECT_EQ(dropped(back).size() + 1, dropped(without).size());
}

// Springs could be spared before the pitch that they hold: what is left always makes sense, however much may
// go, and what comes back brings what it needs.
TEST(EffectChoice, NothingIsLeftWithoutWhatItNeeds) {
  Scene scene = shaft_scene();
  for (const double limit : {0.01, 0.03, 0.1, 0.3, 0.9})
    EXPECT_TRUE(has_what_it_needs(chosen(scene, limit))) << limit;
  Scene left = with_effects(scene, {"structure_inertia"});
  left.effect_choice.dropped = {{"springs", 0}, {"pitch", 0}, {"charge_follows_pitch", 0}};
  left = with_effect_back(left, "charge_follows_pitch");
  EXPECT_TRUE(has_what_it_needs(left));
  EXPECT_EQ(left.effects.size(), 4u);
  EXPECT_TRUE(left.effect_choice.dropped.empty());
  EXPECT_FALSE(has_what_it_needs(with_effects(scene, {"pitch"})));
}

// Bounds of 3 and 5 Pa, 7 together, on a stress of 1000 Pa: within 1 %, beyond 0.5 %, where the larger comes
// back.
TEST(EffectChoice, WhatTurnsOutToMatterComesBack) {
  Scene scene;
  scene.effect_choice.dropped = {{"a", 0}, {"b", 0}};
  Judged analysis;
  analysis.peak.value_Pa = 1000;
  analysis.dropped = DroppedBounds{{{"a", 3, 0}, {"b", 5, 0}}, {"", 7, 0}};
  scene.effect_choice.limit = 0.01;
  EXPECT_EQ(effect_to_take_back(scene, {analysis}), "");
  scene.effect_choice.limit = 0.005;
  EXPECT_EQ(effect_to_take_back(scene, {analysis}), "b");
  analysis.dropped.reset();
  EXPECT_EQ(effect_to_take_back(scene, {analysis}), "");
}

TEST(EffectChoice, LimitIsATenthOfTheTolerance) {
  EXPECT_NEAR(negligible_share(0.02), 0.002, 1e-16);
  EXPECT_NEAR(negligible_share(0), 0.005, 1e-16);
}
