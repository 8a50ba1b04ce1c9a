#include "pipelines/scene/reader/scene_duty.h"

#include <algorithm>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

/// What an operating point is made of; all else is of the scene as a whole, or of the body that all blocks
/// share.
const std::vector<std::string> keys_of_a_block = {"machine", "effects", "sampling"};

/// Shares are written with few digits: three thirds as 33.3 %.
constexpr double rounding_of_shares = 1e-9;

std::optional<DutyStart> read_start(SceneTable& table, const Scene& scene) {
  if (!table.is_given("start")) return std::nullopt;
  auto entry = table.table("start");
  DutyStart start;
  start.per_day = entry.quantity("per_day", "1", positive(86400));
  if (entry.is_given("duration")) {
    start.duration_s = entry.quantity("duration", "s", positive(3600));
    if (const auto why_not = kind_of(scene.machine).why_no_run_up_of_given_duration(); !why_not.empty())
      entry.refuse("duration", why_not);
  }
  entry.finish();
  return start;
}

/// Refuses every value in a table that no block may change.
/// @param key  key of the table: "duty[2].set.shaft"
void refuse_all_values(const TomlNode& node, const std::string& key, SceneFindings& findings) {
  if (node.kind == TomlNode::Kind::table && node.entries.size() > 0) {
    for (const auto& entry : node.entries) refuse_all_values(entry.value, key + "." + entry.key, findings);
    return;
  }
  findings.errors.push_back({findings.file, node.at.line, node.at.column, key, node.as_written,
                             "is the same in all blocks, which are operating points of one body; a block "
                             "sets keys of machine, effects and sampling only: write it outside the blocks"});
}

/// @return whether a block's table `set` has only keys that a block may change
bool allow_keys(const TomlNode& set, const std::string& key, SceneFindings& findings) {
  bool all_allowed = true;
  for (const auto& entry : set.entries)
    if (!contains(keys_of_a_block, entry.key.substr(0, entry.key.find_first_of(".[")))) {
      refuse_all_values(entry.value, key + "." + entry.key, findings);
      all_allowed = false;
    }
  return all_allowed;
}

/// The scene's tree with a block's keys; nothing where one is refused.
std::optional<TomlNode> tree_of_block(const TomlNode& tree, std::size_t block, const std::string& key,
                                      SceneTable& table, SceneFindings& findings) {
  TomlNode version = without_duty(tree);
  if (!table.is_given("set")) return version;
  table.table("set");  // refuses what is no table
  const auto& set = tree.find("duty")->value.items[block].find("set")->value;
  if (!allow_keys(set, key + ".set", findings)) return std::nullopt;
  try {
    set_entries(version, set, key + ".set", findings.file);
  } catch (const SceneError& error) {
    findings.errors.insert(findings.errors.end(), error.findings().begin(), error.findings().end());
    return std::nullopt;
  }
  return version;
}

bool sets_sampling(const TomlNode& block) {
  const auto* set = block.find("set");
  return set != nullptr &&
         std::any_of(set->value.entries.begin(), set->value.entries.end(), [](const TomlEntry& entry) {
           return entry.key.substr(0, entry.key.find('.')) == "sampling";
         });
}

/// Nothing where the block's version is refused.
/// @param block  its table
std::shared_ptr<const Scene> scene_of_block(const TomlNode& version, const TomlNode& block,
                                            const Scene& scene, const std::string& name,
                                            SceneFindings& findings) {
  VersionReading reading;
  reading.has_notes = false;
  reading.takes_instants_of_orders = !sets_sampling(block);
  try {
    return std::make_shared<const Scene>(read_scene(scene.file, version, {}, reading));
  } catch (const SceneError& error) {
    for (auto finding : error.findings()) {
      finding.remedy += " (in the duty block \"" + name + "\")";
      findings.errors.push_back(std::move(finding));
    }
    return nullptr;
  }
}

}  // namespace

TomlNode without_duty(TomlNode tree) {
  if (tree.find("duty") == nullptr) return tree;
  auto& entries = tree.entries.own();
  entries.erase(
      std::remove_if(entries.begin(), entries.end(), [](const TomlEntry& e) { return e.key == "duty"; }),
      entries.end());
  return tree;
}

void read_duty(SceneTable& root, const TomlNode& tree, Scene& scene, SceneFindings& findings) {
  if (!root.is_given("duty")) return;
  auto tables = root.tables("duty");
  if (scene.run_up) {
    root.refuse("duty",
                "a scene of a run-up has no operating blocks; remove machine.run_up: a block's "
                "start has a duration of its own");
    return;
  }
  double sum = 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    auto& table = tables[i];
    DutyBlock block;
    block.name = table.name("name");
    if (contains(names, block.name)) table.refuse("name", "is the name of another block; write another");
    names.push_back(block.name);
    block.share = table.quantity("share", "1", {0, 1, true});
    block.start = read_start(table, scene);
    block.origin = table.origin();
    const auto version = tree_of_block(tree, i, table.key(), table, findings);
    table.finish();
    sum += block.share;
    if (!(sum <= 1 + rounding_of_shares)) {
      if (sum > 1) table.refuse("share", "the shares of the blocks add up to more than 100 %; lower one");
      continue;
    }
    if (!version || !findings.errors.empty()) continue;
    block.scene = scene_of_block(*version, tree.find("duty")->value.items[i], scene, block.name, findings);
    if (block.scene) scene.duty.push_back(std::move(block));
  }
  const bool is_used = !scene.bearings.empty() || std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                                              [](const auto& b) { return b.fatigue; });
  if (!is_used)
    findings.warnings.push_back(
        "duty: without fatigue of a body or [[bearings]] the blocks have no use but their largest stresses");
}

}  // namespace pipelines
