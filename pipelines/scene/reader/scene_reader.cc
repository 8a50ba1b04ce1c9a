#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "meshes/values/utf8.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/text_encoding.h"
#include "pipelines/base/files/toml_tree.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/name_fault.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/scene/reader/scene_duty.h"
#include "pipelines/scene/reader/scene_stages.h"
#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/scene/whole/plausibility.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& remedy) {
  throw SceneError({{file.string(), 0, 0, "", "", remedy}});
}

/// The scene in the same directory with the nearest name; empty if none is near.
std::filesystem::path nearest_scene(const std::filesystem::path& file) {
  constexpr std::size_t most_files = 10'000;
  const auto directory = file.parent_path();
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator entries(directory.empty() ? "." : directory, error);
  for (std::size_t n = 0; !error && entries != std::filesystem::directory_iterator() && n < most_files; ++n) {
    if (entries->path().extension() == ".toml") names.push_back(entries->path().filename().string());
    entries.increment(error);
  }
  std::sort(names.begin(), names.end());
  const auto nearest = nearest_name(file.filename().string(), names);
  return nearest.empty() ? std::filesystem::path() : directory / nearest;
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    const auto nearest = nearest_scene(file);
    refuse_file(file, nearest.empty() ? "there is no such file; give the path of a scene, such as "
                                        "pipelines/scenes/vibratory_mill.toml"
                                      : "there is no such file; did you mean \"" + nearest.string() + "\"?");
  }
  if (std::filesystem::is_directory(status))
    refuse_file(file, "is a directory; give the path of a scene, a .toml file");
  constexpr std::uintmax_t most_bytes = 10'000'000;
  if (!std::filesystem::is_regular_file(status) || size_of_file(file) > most_bytes)
    refuse_file(file, "is no ordinary file of less than 10 MB; give the path of a scene, a .toml file");
  note_input(file);
  auto text = whole_file(file, most_bytes);
  if (!text) refuse_file(file, "cannot be read; check its permissions");
  if (const auto wide = wide_encoding_of(*text); !wide.empty())
    throw SceneError(
        {{file.string(), 1, 1, "", "",
          "is not TOML: it is written in " + wide + ", and a scene is UTF-8; save it as UTF-8"}});
  return *std::move(text);
}

}  // namespace

TomlNode read_scene_tree(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (!meshes::is_utf8(name) || !control_character_in(name).empty())
    refuse_file(file, "the file's name stands in the results, and is no text in UTF-8; rename the file");
  TomlNode root;
  try {
    root = parse_toml(read_text(file));
  } catch (const TomlSyntaxError& error) {
    const auto [line, column] = error.at();
    throw SceneError({{file.string(), line, column, "", "",
                       "is not TOML: " + std::string(error.what()) + "; correct the line"}});
  }
  if (root.entries.empty())
    refuse_file(file, "the scene is empty; begin with a copy of pipelines/scenes/vibratory_mill.toml");
  return root;
}

namespace {

/// Names of all machine types: "vibratory_mill", "planetary_mill" ...
std::string machine_types() {
  std::string types;
  for (const auto* kind : machine_kinds()) types += (types.empty() ? "\"" : ", \"") + kind->type() + "\"";
  return types;
}

/// What can be said of a scene whose machine is unknown. There may be no [machine] at all.
void refuse_machine(SceneTable& root, SceneTable& machine, const std::string& type) {
  if (!machine.has("type"))
    machine.refuse_missing("type", "is missing; add it: one of " + machine_types());
  else if (!type.empty())
    machine.refuse("type", "unknown machine; write one of " + machine_types());
  for (const char* key : {"effects", "sampling", "bearings", "zones", "results", "tolerance", "time_limit",
                          "method", "sweep", "duty", "limits"})
    root.know(key);
  for (const auto* kind : body_readers())
    for (const auto& table : kind->tables()) root.know(table);
  root.finish();
}

[[noreturn]] void throw_sorted(std::vector<SceneFinding> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const SceneFinding& a, const SceneFinding& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  throw SceneError(std::move(errors));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return read_scene(file, read_scene_tree(file), settings);
}

Scene read_scene(const std::filesystem::path& file, TomlNode tree, const std::vector<std::string>& settings,
                 const VersionReading& version) {
  SceneFindings findings;
  findings.warnings = set_keys(tree, settings, file);
  findings.file = file.string();
  findings.are_noted = version.has_notes;
  SceneTable root(tree, "", findings);

  Scene scene;
  scene.file = file;
  scene.settings = settings;
  scene.keys = texts_by_key(tree);
  scene.title = root.text_or("title", file.stem().string(), "the name of the file");
  SceneTable machine = root.table("machine");
  const std::string type = machine.has("type") ? machine.text("type") : "";
  scene.machine_origin = machine.origin();
  const auto places = root.places_in("machine");
  if (const auto at = places.find("type"); at != places.end()) scene.machine_type_at = at->second;
  const MachineKind* const kind = find_machine_kind(type);
  if (kind == nullptr) {
    refuse_machine(root, machine, type);
    throw_sorted(findings.errors);
  }
  scene.limits =
      read_limits(root.table_or_empty("limits"));  // before the bodies, whose fatigue asks for a life
  SceneReading reading{root, machine, scene, findings, {}};
  kind->read(reading);
  scene.sampling = read_sampling(root.table_or_empty("sampling"), scene, findings);
  if (version.takes_instants_of_orders && findings.errors.empty())
    scene.sampling.instants_per_turn =
        std::max(scene.sampling.instants_per_turn, kind->instants_of_orders(scene.machine));
  std::vector<SceneTable> bodies = reading.bodies ? *reading.bodies : read_bodies(root, scene, findings);
  if (bodies.empty() && (root.has("zones") || root.has("results")))
    findings.warnings.push_back("without a body ([shaft], [chamber] ...) [zones] and [results] have no use");
  scene.bearings = read_bearings(root);
  scene.accuracy = read_requested_accuracy(root);
  scene.method = read_method(root, scene);
  root.know("sweep");  // for the command of that name (study/variations/sweep_request.h)
  scene.zones = read_zones(root.table_or_empty("zones"));
  read_results(root.table_or_empty("results"), scene);
  if (findings.errors.empty())
    read_duty(root, tree, scene, findings);
  else
    root.know("duty");
  root.finish();

  if (findings.errors.empty()) rehearse(scene, root, machine, bodies, version);
  if (!findings.errors.empty()) throw_sorted(std::move(findings.errors));
  scene.defaults = std::move(findings.defaults);
  scene.warnings = std::move(findings.warnings);
  scene.known_keys.assign(findings.keys.begin(), findings.keys.end());
  scene.key_forms = std::move(findings.forms);
  for (auto& doubt : implausible(scene)) scene.warnings.push_back(std::move(doubt));
  return scene;
}

}  // namespace pipelines
