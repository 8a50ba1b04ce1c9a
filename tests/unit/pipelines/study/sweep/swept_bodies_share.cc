/// What points of a sweep may share of a body: never a mesh that differs.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "pipelines/loads/stage/same_body.h"
#include "pipelines/scene/reader/scene_tree.h"

using namespace pipelines;

namespace {

const std::filesystem::path scenes = std::filesystem::path(SOURCE_DIR) / "pipelines/scenes";

/// Keys of a body's table that say how loads meet it or how it is judged; its mesh and stiffness are the
/// same.
bool is_of_loads(const std::string& key) {
  static const std::regex loads(
      R"(.*\.(pressure_harmonics|half_angle|harmonics|debalance_shares.*|natural_frequencies|yield_strength|name|mass|polar_inertia|centre.*|bearing_span|pulley_plane|pulley_mass|force.*|pitch_guide|pulley_side)(\[\d+\])?|.*added_masses.*|.*forces.*|.*fatigue\..*|.*\.material\.thickness|.*pressure\..*)");
  return std::regex_match(key, loads);
}

void collect(const TomlNode& node, const std::string& key,
             std::vector<std::pair<std::string, const TomlNode*>>& leaves) {
  for (const auto& entry : node.entries)
    collect(entry.value, key.empty() ? entry.key : key + "." + entry.key, leaves);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    collect(node.items[i], key + "[" + std::to_string(i + 1) + "]", leaves);
  if (node.entries.empty() && node.items.empty()) leaves.emplace_back(key, &node);
}

/// The value made larger by some per cent, as --set has it; empty where that is no number.
std::string a_little_more(const TomlNode& node) {
  static const std::regex number(R"(^(-?[0-9.]+)(.*)$)");
  std::smatch parts;
  if (node.kind == TomlNode::Kind::integer)
    return std::to_string(node.integer + (node.integer % 4 == 0 ? 4 : 2));
  if (node.kind == TomlNode::Kind::number) return std::to_string(node.number * 0.97);
  if (node.kind == TomlNode::Kind::text && std::regex_match(node.text, parts, number))
    return std::to_string(std::stod(parts[1]) * 0.97) + parts[2].str();
  return "";
}

}  // namespace

// Every number in a body's tables of the shipped scenes, changed by 3 per cent: another mesh, or another
// stiffness, unless it is known to be one of the loads. A field that the comparison forgets shows here.
TEST(SweptBodies, EveryKeyOfABodyMakesAnother) {
  int n_changed = 0;
  for (const char* file :
       {"vibratory_mill", "planetary_mill", "stub_axle", "root_peeler_shaft", "load_table"}) {
    const auto path = scenes / (std::string(file) + ".toml");
    const auto tree = read_scene_tree(path);
    const auto scene = read_scene(path, tree, {});
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const auto* const table = tree.find(scene.bodies[b].name);
      ASSERT_NE(table, nullptr) << scene.bodies[b].name;
      std::vector<std::pair<std::string, const TomlNode*>> leaves;
      collect(table->value, scene.bodies[b].name, leaves);
      for (const auto& [key, node] : leaves) {
        const auto value = a_little_more(*node);
        if (value.empty() || is_of_loads(key)) continue;
        Scene changed;
        try {
          changed = read_scene(path, tree, {key + "=" + value});
        } catch (const std::exception&) {
          continue;  // this scene cannot have it
        }
        ++n_changed;
        EXPECT_FALSE(have_one_mesh(scene.bodies[b], changed.bodies[b]) &&
                     have_one_stiffness(scene, changed, b))
            << file << ": " << key << "=" << value;
      }
    }
  }
  EXPECT_GT(n_changed, 60);
}

// Every number of the shipped scenes, a little less and much more: what is read without checking known
// shapes again and without notes is refused in the same words, or is the same scene.
TEST(SweptBodies, AreRefusedAsIfTheyWereReadAlone) {
  int n_refused = 0, n_refused_shapes = 0;
  for (const char* file :
       {"vibratory_mill", "planetary_mill", "stub_axle", "root_peeler_shaft", "load_table"}) {
    const auto path = scenes / (std::string(file) + ".toml");
    const auto tree = read_scene_tree(path);
    const auto scene = read_scene(path, tree, {});
    const auto is_accepted = [&](const BodyScene& body) {
      return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                         [&](const BodyScene& other) { return have_one_mesh(other, body); });
    };
    const auto outcome = [&](const std::vector<std::string>& settings, const VersionReading& version) {
      try {
        const auto read = read_scene(path, tree, settings, version);
        return std::to_string(read.warnings.size()) + " warnings, " + std::to_string(read.effects.size()) +
               " effects";
      } catch (const std::exception& error) {
        return std::string(error.what());
      }
    };
    std::vector<std::pair<std::string, const TomlNode*>> leaves;
    collect(tree, "", leaves);
    for (const auto& [key, node] : leaves)
      for (const auto& value : {a_little_more(*node), std::string("3 mm"), std::string("0.2 m")}) {
        if (value.empty()) continue;
        const auto wanted = outcome({key + "=" + value}, {});
        EXPECT_EQ(outcome({key + "=" + value}, {is_accepted, false}), wanted) << key << '=' << value;
        n_refused += wanted.find("--set") != std::string::npos || wanted.find(".toml") != std::string::npos;
        n_refused_shapes += wanted.find("the mesher refuses") != std::string::npos;
      }
  }
  EXPECT_GT(n_refused, 100);
  EXPECT_GT(n_refused_shapes, 3);
}

TEST(SweptBodies, OfOtherSpeedAreTheSame) {
  const auto path = scenes / "vibratory_mill.toml";
  const auto tree = read_scene_tree(path);
  const auto scene = read_scene(path, tree, {});
  const auto faster = read_scene(path, tree, {"machine.drive.speed=1500 rpm", "machine.charge.mass=18 kg"});
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    EXPECT_TRUE(have_one_mesh(scene.bodies[b], faster.bodies[b]));
    EXPECT_TRUE(have_one_stiffness(scene, faster, b));
  }
}

// The chamber takes places of its feet and its axis from the machine.
TEST(SweptBodies, TakeTheirShapeFromTheMachineToo) {
  const auto path = scenes / "vibratory_mill.toml";
  const auto tree = read_scene_tree(path);
  const auto scene = read_scene(path, tree, {});
  const auto moved = read_scene(path, tree, {"machine.springs[1].position=[\"105 mm\", \"-180 mm\"]"});
  EXPECT_TRUE(have_one_mesh(scene.bodies[0], moved.bodies[0]));
  EXPECT_FALSE(have_one_mesh(scene.bodies[1], moved.bodies[1]));
  const auto elastic = read_scene(path, tree, {"chamber.elastic_feet=true"});
  EXPECT_TRUE(have_one_mesh(scene.bodies[1], elastic.bodies[1]));
  EXPECT_FALSE(have_one_stiffness(scene, elastic, 1));
  const auto stiffer = read_scene(
      path, tree, {"chamber.elastic_feet=true", "machine.springs[1].stiffness=[\"20 kN/m\", \"40 kN/m\"]"});
  EXPECT_FALSE(have_one_stiffness(elastic, stiffer, 1));
}
