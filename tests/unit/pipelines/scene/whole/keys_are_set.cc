// Keys that the command line sets stand for what the file says; what cannot be set is refused by its key.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "pipelines/base/common/errors.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/scene/whole/scene.h"

namespace {

using Settings = std::vector<std::string>;

const std::filesystem::path shipped =
    std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml";

/// The message of the refusal.
std::string refusal_of_settings(const Settings& settings) {
  try {
    pipelines::read_scene(shipped, settings);
  } catch (const pipelines::SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(KeySettings, StandForWhatTheFileSays) {
  const auto scene = pipelines::read_scene(
      shipped, {"machine.drive.speed=1500 rpm", "machine.springs[2].damping=[1, \"2 N s/m\"]",
                "sampling.turns = 1", "machine.drive.initial_angle=\"90 deg\""});
  const auto& mill = scene.vibratory_mill();
  EXPECT_NEAR(mill.speed_rad_s, 1500 * M_PI / 30, 1e-12 * 157);
  EXPECT_NEAR(mill.initial_angle_rad, M_PI / 2, 1e-15);
  EXPECT_EQ(mill.springs.at(1).damping_N_s_m[0], 1);
  EXPECT_EQ(mill.springs.at(1).damping_N_s_m[1], 2);
  EXPECT_EQ(mill.springs.at(0).damping_N_s_m[0], 30);
  EXPECT_EQ(scene.sampling.turns, 1);
  EXPECT_EQ(scene.settings.size(), 4u);
}

TEST(KeySettings, AddTablesThatTheFileLeavesOut) {
  pipelines::TomlNode root = pipelines::parse_toml("a = 1\n[[list]]\nx = 1\n[[list]]\nx = 2\n");
  pipelines::set_keys(root, {"b.c.d=true", "list[2].x=[[1, 2], [3]]", "list[2].x[1][2]=7", "a={ k = \"v\" }"},
                      "scene.toml");
  EXPECT_TRUE(root.find("b")->value.find("c")->value.find("d")->value.boolean);
  const auto& x = root.find("list")->value.items.at(1).find("x")->value;
  EXPECT_EQ(x.items.at(0).items.at(1).integer, 7);
  EXPECT_EQ(x.items.at(1).items.at(0).integer, 3);
  EXPECT_EQ(root.find("list")->value.items.at(0).find("x")->value.integer, 1);
  EXPECT_EQ(root.find("a")->value.find("k")->value.text, "v");
}

// Copies of a tree share what no setting touches: it is the same place in memory, and what is set in one is
// not seen in another.
TEST(KeySettings, OfACopyLeaveTheTreeAsItIs) {
  const auto root = pipelines::parse_toml("[a]\nx = 1\ny = [1, [2, 3]]\n[b]\nz = 1\n[[list]]\nx = 1\n");
  auto copy = root;
  pipelines::set_keys(copy, {"a.x=2", "a.y[2][1]=7", "list[1]=removed", "c.d=1"}, "scene.toml");
  EXPECT_EQ(copy.find("a")->value.find("x")->value.integer, 2);
  EXPECT_EQ(copy.find("a")->value.find("y")->value.items[1].items[0].integer, 7);
  EXPECT_TRUE(copy.find("list")->value.items.empty());
  EXPECT_EQ(root.find("a")->value.find("x")->value.integer, 1);
  EXPECT_EQ(root.find("a")->value.find("y")->value.items[1].items[0].integer, 2);
  EXPECT_EQ(root.find("list")->value.items.size(), 1u);
  EXPECT_EQ(root.find("c"), nullptr);
  EXPECT_EQ(root.find("b")->value.entries.begin(), copy.find("b")->value.entries.begin());
}

// What the TOML parser takes is TOML; a number with a unit is a text.
TEST(KeySettings, AreTomlOrElseTexts) {
  using Kind = pipelines::TomlNode::Kind;
  const std::vector<std::pair<std::string, Kind>> values = {
      {"1450 rpm", Kind::text}, {"-3 mm", Kind::text},         {"+1.5e3   N s/m", Kind::text},
      {"1450rpm", Kind::text},  {"1 2", Kind::text},           {"1 # rpm", Kind::integer},
      {"0x1F", Kind::integer},  {"-1/20", Kind::text},         {"1e3", Kind::number},
      {"inf", Kind::number},    {"1979-05-27", Kind::date},    {"1979-05-27 07:32:00", Kind::date},
      {"[1, 2] ", Kind::array}, {"1979-05-27 at", Kind::text}, {"1979-05-27T07:32:00Z", Kind::date},
      {"\"1 mm\"", Kind::text}, {"{ x = 1 }", Kind::table},    {"1_000 mm", Kind::text}};
  for (const auto& [value, kind] : values) {
    pipelines::TomlNode root;
    pipelines::set_keys(root, {"k=" + value}, "scene.toml");
    EXPECT_EQ(describe(root.find("k")->value.kind), describe(kind)) << value;
  }
}

TEST(KeySettings, RemoveKeysAndItemsByTheirNumbersInTheFile) {
  pipelines::TomlNode root =
      pipelines::parse_toml("a = 1\nb = \"removed\"\n[[list]]\nx = 1\n[[list]]\nx = 2\n[[list]]\nx = 3\n");
  pipelines::set_keys(root,
                      {"list[1]=removed", "list[3].x=4", "list[2]=removed", "a=removed", "b=\"removed\""},
                      "scene.toml");
  EXPECT_EQ(root.find("a"), nullptr);
  EXPECT_EQ(root.find("b")->value.text, "removed");
  const auto& list = root.find("list")->value.items;
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].find("x")->value.integer, 4);
}

TEST(KeySettings, SwitchSingleEffects) {
  const auto scene =
      pipelines::read_scene(shipped, {"effects.spring_damping=off", "effects.charge_lag = on"});
  EXPECT_FALSE(scene.has_effect("spring_damping"));
  EXPECT_TRUE(scene.has_effect("charge_lag"));
  EXPECT_NE(refusal_of_settings({"effects.spring_dampin=off"}).find("effects does not have it"),
            std::string::npos);
  EXPECT_NE(refusal_of_settings({"effects.spring_dampin=on"}).find("spring_dampin"), std::string::npos);
  EXPECT_NE(refusal_of_settings({"effects.springs=3"}).find("write on or off"), std::string::npos);
}

/// What went with a body, and the tree that is left.
std::vector<std::string> told_of(pipelines::TomlNode& root, const std::string& body) {
  return pipelines::set_keys(root, {body + "=removed"}, "scene.toml");
}

// Every shipped scene whose machine knows its masses by itself is one of loads alone, without further keys.
TEST(KeySettings, TakeWhatNeedsABodyAwayWithIt) {
  const auto scenes = std::filesystem::path(SOURCE_DIR) / "pipelines/scenes";
  const std::vector<std::tuple<std::string, std::string, Settings>> bodies{
      {"vibratory_mill.toml", "shaft", {"gravity_shaft", "shaft_inertia"}},
      {"vibratory_mill_duty.toml", "shaft", {"gravity_shaft", "shaft_inertia"}},
      {"planetary_mill.toml", "drum", {"drum_spin"}},
      {"stub_axle.toml", "axle", {"axle_gravity", "axle_transport"}}};
  for (const auto& [file, body, effects] : bodies) {
    const auto scene = pipelines::read_scene(scenes / file, {body + "=removed"});
    EXPECT_EQ(scene.body(body), nullptr) << file;
    for (const auto& effect : effects) {
      EXPECT_FALSE(scene.has_effect(effect)) << file << effect;
      const auto told =
          "[" + body + "] is removed, and with it the effect \"" + effect + "\", which needs it";
      EXPECT_EQ(std::count(scene.warnings.begin(), scene.warnings.end(), told), 1) << file << effect;
    }
  }
}

TEST(KeySettings, TakeBearingsBlocksAndSweepsOfABodyAwayWithIt) {
  auto root = pipelines::parse_toml(R"(effects = ["pull", "own", "shaft_inertia"]
[machine]
type = "drive_train"
[[machine.excitations]]
name = "pull"
[shaft]
bearings = ["left", "right"]
[[shaft.forces]]
effect = "own"
[[shaft.forces]]
effect = "pull"
[[bearings]]
name = "1"
load = "right"
[[bearings]]
name = "2"
load = "belt"
[[duty]]
name = "slow"
set.effects = { own = "off", pull = "on" }
[[duty]]
name = "fast"
set."effects.shaft_inertia" = "off"
[sweep]
vary = ["shaft.material.density = 7800, 7900 kg/m3", "effects.own = on, off", "shafts = 1, 2"]
)");
  const auto told = told_of(root, "shaft");
  EXPECT_EQ(told.size(), 7u) << testing::PrintToString(told);
  const auto& effects = root.find("effects")->value.items;
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].text, "pull");
  const auto& bearings = root.find("bearings")->value.items;
  ASSERT_EQ(bearings.size(), 1u);
  EXPECT_EQ(bearings[0].find("name")->value.text, "2");
  const auto& blocks = root.find("duty")->value.items;
  EXPECT_EQ(blocks[0].find("set")->value.find("effects")->value.entries.size(), 1u);
  EXPECT_EQ(blocks[1].find("set")->value.entries.size(), 0u);
  ASSERT_EQ(root.find("sweep")->value.find("vary")->value.items.size(), 1u);
  EXPECT_EQ(root.find("sweep")->value.find("vary")->value.items[0].text, "shafts = 1, 2");
}

// Ports of a mill's shaft that its kind names.
TEST(KeySettings, TakeBearingsAtPortsOfTheKindAwayWithTheBody) {
  auto root = pipelines::parse_toml(
      "effects = []\n[machine]\ntype = \"vibratory_mill\"\n[shaft]\n"
      "[[bearings]]\nname = \"1\"\nload = \"main_bearing_1\"\n[[bearings]]\nname = \"2\"\nload = \"R_E\"\n");
  const auto told = told_of(root, "shaft");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], "[shaft] is removed, and with it the bearing \"1\", which needs it");
}

// What is no body of the machine takes nothing along.
TEST(KeySettings, ThatRemoveNoBodyTakeNothingElse) {
  auto root =
      pipelines::parse_toml("effects = [\"drum_spin\"]\n[machine]\ntype = \"vibratory_mill\"\n[drum]\n");
  EXPECT_TRUE(told_of(root, "drum").empty());
  EXPECT_EQ(root.find("effects")->value.items.size(), 1u);
}

TEST(KeySettings, ThatLeadNowhereAreRefused) {
  std::string long_key = "a";
  for (int i = 0; i < 50'000; ++i) long_key += ".a";
  const std::vector<std::pair<Settings, std::string>> cases{
      {{"machine.drive.speed"}, "is no setting"},
      {{"machine.drive.speed= "}, "has no value"},
      {{"machine.springs[3]=removed"}, "has 2 items"},
      {{"machine.nothing=removed"}, "has no machine.nothing"},
      {{"machine.drive.speed.x.y=removed"}, "has no machine.drive.speed.x"},
      {{"=3"}, "is no setting"},
      {{"machine..drive=3"}, "empty name"},
      {{".machine=3"}, "empty name"},
      {{"machine.=3"}, "empty name"},
      {{"sampling.turns=1\n2"}, "control character"},
      {{"title=\xff"}, "is not UTF-8"},
      {{long_key + "=1"}, "more than 100 parts"},
      {{"machine.springs[3].stiffness=3"}, "machine.springs has 2 items"},
      {{"machine.springs[0].stiffness=3"}, "the first is [1]"},
      {{"machine.springs[1x].stiffness=3"}, "the first is [1]"},
      {{"machine.springs[1.stiffness=3"}, "the first is [1]"},
      {{"machine.springs[1]x=3"}, "the first is [1]"},
      {{"machine.drive[1]=3"}, "is a table, not an array"},
      {{"machine.drive.speed.x=3"}, "is a text and has no keys"},
      {{"nothing[1]=3"}, "the scene has no nothing"},
      {{"sampling.turns=1", "sampling.turns=2"}, "set it once"},
      {{"machine.drive.sped=3"}, "machine.drive.sped = 3 (by --set): unknown key"},
      {{"machine.drive.speed=fast"},
       "machine.drive.speed = \"fast\" (by --set): does not begin with a number"}};
  for (const auto& [settings, fragment] : cases) {
    const auto message = refusal_of_settings(settings);
    EXPECT_NE(message.find(fragment), std::string::npos) << settings.front() << ": " << message;
    EXPECT_NE(message.find("vibratory_mill.toml"), std::string::npos) << message;
  }
}

}  // namespace
