#include "pipelines/scene/scene_duty.h"

#include <algorithm>

#include "pipelines/common/errors.h"
#include "pipelines/common/name_lists.h"
#include "pipelines/scene/key_settings.h"
#include "pipelines/scene/machine_kind.h"

namespace pipelines {
namespace {

/// What belongs to the run as a whole.
const std::vector<std::string> never_of_a_block = {"title",   "tolerance", "time_limit", "method",  "zones",
                                                   "results", "sweep",     "duty",       "bearings"};

/// Shares are written with few digits: three thirds as 33.3 %.
constexpr double rounding_of_shares = 1e-9;

std::optional<DutyStart> read_start(SceneTable& table, const Scene& scene) {
  table.know("start");
  if (!table.has("start")) return std::nullopt;
  auto entry = table.table("start");
  DutyStart start;
  start.per_day = entry.quantity("per_day", "1", positive(86400));
  entry.know("duration");
  if (entry.has("duration")) {
    start.duration_s = entry.quantity("duration", "s", positive(3600));
    if (const auto why_not = kind_of(scene.machine).why_no_run_up_of_given_duration(); !why_not.empty())
      entry.refuse("duration", why_not);
  }
  entry.finish();
  return start;
}

/// The scene's tree with a block's keys; nothing where one is refused.
std::optional<TomlNode> tree_of_block(const TomlNode& tree, std::size_t block, const std::string& key,
                                      SceneTable& table, SceneFindings& findings) {
  TomlNode version = without_duty(tree);
  table.know("set");
  if (!table.has("set")) return version;
  for (const auto& name : table.table("set").names())
    if (contains(never_of_a_block, name.substr(0, name.find_first_of(".[")))) {
      table.refuse("set", name + " belongs to the scene as a whole; take it out of the block");
      return std::nullopt;
    }
  try {
    const auto& items = tree.find("duty")->value.items;
    set_entries(version, items[block].find("set")->value, key + ".set", findings.file);
  } catch (const SceneError& error) {
    findings.errors.insert(findings.errors.end(), error.findings().begin(), error.findings().end());
    return std::nullopt;
  }
  return version;
}

/// Nothing where the block's version is refused.
std::shared_ptr<const Scene> scene_of_block(const TomlNode& version, const Scene& scene,
                                            const std::string& name, SceneFindings& findings) {
  VersionReading reading;
  reading.has_notes = false;
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
  root.know("duty");
  if (!root.has("duty")) return;
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
    block.name = table.text("name");
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
    block.scene = scene_of_block(*version, scene, block.name, findings);
    if (block.scene) scene.duty.push_back(std::move(block));
  }
  const bool is_used = !scene.bearings.empty() || std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                                              [](const auto& b) { return b.fatigue; });
  if (!is_used)
    findings.warnings.push_back(
        "duty: without [<body>.fatigue] or [[bearings]] the blocks have no use but their largest stresses");
}

}  // namespace pipelines
