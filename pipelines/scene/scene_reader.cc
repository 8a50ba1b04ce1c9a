#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "kinetics/machine_refused.h"
#include "pipelines/common/nearest_name.h"
#include "pipelines/common/units.h"
#include "pipelines/files/toml_tree.h"
#include "pipelines/scene/body_effects.h"
#include "pipelines/scene/body_kind.h"
#include "pipelines/scene/plausibility.h"
#include "pipelines/scene/scene.h"
#include "pipelines/scene/scene_body.h"
#include "pipelines/scene/scene_effects.h"
#include "pipelines/scene/scene_load_table.h"
#include "pipelines/scene/scene_machine.h"
#include "pipelines/scene/scene_planetary.h"
#include "pipelines/scene/scene_stages.h"
#include "pipelines/scene/scene_table.h"
#include "pipelines/scene/scene_train.h"

namespace pipelines {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& remedy) {
  throw SceneError({{file.string(), 0, 0, "", "", remedy}});
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    refuse_file(
        file,
        "there is no such file; give the path of a scene, such as pipelines/scenes/vibratory_mill.toml");
  if (std::filesystem::is_directory(status))
    refuse_file(file, "is a directory; give the path of a scene, a .toml file");
  constexpr std::uintmax_t most_bytes = 10'000'000;
  if (!std::filesystem::is_regular_file(status) || std::filesystem::file_size(file, error) > most_bytes)
    refuse_file(file, "is no ordinary file of less than 10 MB; give the path of a scene, a .toml file");
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) refuse_file(file, "cannot be read; check its permissions");
  return text;
}

TomlNode parse(const std::filesystem::path& file) {
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

const std::string machine_types = "\"vibratory_mill\", \"planetary_mill\", \"drive_train\", \"load_table\"";

/// The published formulas leave out terms that a body would feel as a resultant without a counterpart.
void refuse_open_balance(SceneTable& machine, const kinetics::VibratoryMill& mill) {
  const double omega2 = mill.speed_rad_s * mill.speed_rad_s;
  const auto kN = [](double force_N) { return shown(std::round(force_N / 10) / 100) + " kN"; };
  machine.refuse("convention",
                 "the published formulas do not close: they leave out m r omega^2 = " +
                     kN(mill.charge_mass_kg * mill.charge_offset_m * omega2) +
                     " of the charge and (m1 + m2) ecc omega^2 = " +
                     kN((mill.structure_mass_kg + mill.exciter_mass_kg) * mill.eccentricity_m * omega2) +
                     " of the moving structure, which a body in equilibrium needs; write \"consistent\", or "
                     "remove the bodies for "
                     "the load stage alone");
}

/// Tables of bodies, and what they are there.
using BodyTables = std::vector<std::pair<std::string, const BodyKind*>>;

/// Of all machines; a name that several kinds have once.
BodyTables all_bodies() {
  BodyTables all;
  for (const auto* kind : body_kinds())
    for (const auto& name : kind->tables())
      if (std::none_of(all.begin(), all.end(), [&](const auto& known) { return known.first == name; }))
        all.emplace_back(name, kind);
  return all;
}

BodyTables bodies_of(const std::string& machine_type) {
  BodyTables own;
  for (const auto* kind : body_kinds())
    if (kind->machine_type() == machine_type)
      for (const auto& name : kind->tables()) own.emplace_back(name, kind);
  return own;
}

/// Tables of the scene's bodies, in the order of bodies_of; those of other machines are refused.
std::vector<SceneTable> read_bodies(SceneTable& root, const std::string& machine_type, Scene& scene,
                                    SceneFindings& findings) {
  std::vector<SceneTable> tables;
  const BodyTables own = bodies_of(machine_type);
  for (const auto& [name, kind] : own) {
    root.know(name);
    if (!root.has(name)) continue;
    tables.push_back(root.table(name));
    scene.bodies.push_back(read_body(tables.back(), *kind, scene, findings));
  }
  for (const auto& [name, kind] : all_bodies()) {
    if (std::any_of(own.begin(), own.end(), [n = name](const auto& b) { return b.first == n; })) continue;
    if (!root.has(name)) continue;
    std::vector<std::string> names;
    for (const auto& body : own) names.push_back(body.first);
    root.know(name);
    root.refuse(name, "this machine has no " + name + " to be analysed; it has " + listed(names));
  }
  if (scene.body("drum") && scene.body("axle"))
    tables.back().refuse_missing("", "a drum with trunnions needs no stub axle: analyse one of the two");
  return tables;
}

void read_vibratory_mill_scene(SceneTable& root, SceneTable& machine, Scene& scene, SceneFindings& findings) {
  const auto convention = read_convention(machine);
  EffectRules rules = vibratory_mill_rules(convention);
  add_own_effects(rules, "vibratory_mill", root);
  if (!machine.has("charge") || !machine.table("charge").has("lag")) rules.lacking = {"charge_lag"};
  if (!machine.has("springs"))
    for (const char* effect : {"springs", "spring_damping"}) rules.lacking.push_back(effect);
  read_effects(root, rules, scene, findings);
  scene.run_up = read_run_up(machine);
  auto mill = read_vibratory_mill(machine, convention, scene.effects, scene.milling_space,
                                  root.has("chamber") ? &scene.masses_from_mesh : nullptr);
  if (scene.run_up && (root.has("shaft") || root.has("chamber")))
    machine.refuse("run_up", "a run-up belongs to the load stage; remove it, or the bodies, so far");
  if (convention == kinetics::Convention::published && (root.has("shaft") || root.has("chamber")))
    refuse_open_balance(machine, mill);
  scene.machine = std::move(mill);
}

void read_planetary_mill_scene(SceneTable& root, SceneTable& machine, Scene& scene, SceneFindings& findings) {
  const auto convention = read_planetary_convention(machine);
  EffectRules rules = planetary_mill_rules(convention);
  add_own_effects(rules, "planetary_mill", root);
  for (const auto& effect : rules.table)
    if ((effect.name == "belt" && !machine.has("belt")) ||
        (effect.name.rfind("charge_", 0) == 0 && !machine.has("charge")))
      rules.lacking.push_back(effect.name);
  read_effects(root, rules, scene, findings);
  bool from_mesh = false;
  scene.machine =
      read_planetary_mill(machine, convention, scene.effects, scene.drum_axes, root.has("drum"), from_mesh);
  if (from_mesh) scene.masses_from_mesh.push_back("drum");
}

/// Only the inertia that [shaft] is can come from its mesh.
void check_from_mesh(SceneTable& machine, const Scene& scene) {
  if (scene.masses_from_mesh.empty()) return;
  const auto* shaft = scene.body("shaft");
  for (SceneTable& entry : machine.tables("inertias")) {
    if (!entry.has("from_mesh") || !entry.flag_or("from_mesh", false, "")) continue;
    const std::string name = entry.text("name");
    if (shaft == nullptr)
      entry.refuse("from_mesh", "needs a [shaft] whose mesh gives the inertia; add it, or the inertia");
    else if (const auto& own = std::get<TrainShaftOptions>(shaft->options).inertia; name != own)
      entry.refuse("from_mesh", "the mesh is that of [shaft], which is \"" + own +
                                    "\" in the train; give the inertia of \"" + name + "\"");
  }
}

void read_drive_train_scene(SceneTable& root, SceneTable& machine, Scene& scene, SceneFindings& findings) {
  auto train = read_drive_train(machine, scene.torsion, scene.masses_from_mesh);
  root.know("effects");
  scene.machine = train;
  std::vector<SceneTable> tables = read_bodies(root, "drive_train", scene, findings);
  if (findings.errors.empty()) check_from_mesh(machine, scene);
  if (!findings.errors.empty()) return;
  try {
    EffectRules rules{effect_table(train, scene.bodies)};
    add_own_effects(rules, "drive_train", root);
    read_effects(root, rules, scene, findings);
  } catch (const kinetics::MachineRefused& error) {
    machine.refuse_missing("", "the load stage refuses it: " + std::string(error.what()));
  }
}

void read_load_table_scene(SceneTable& root, SceneTable& machine, Scene& scene, SceneFindings& findings) {
  auto table = read_load_table(machine, scene.file.parent_path(), findings);
  root.know("effects");
  if (!table.loads.empty()) read_effects(root, {kinetics::load_table_effects(table)}, scene, findings);
  scene.machine = std::move(table);
}

[[noreturn]] void throw_sorted(std::vector<SceneFinding> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const SceneFinding& a, const SceneFinding& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  throw SceneError(std::move(errors));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  const TomlNode tree = parse(file);
  SceneFindings findings;
  findings.file = file.string();
  SceneTable root(tree, "", findings);

  Scene scene;
  scene.file = file;
  scene.title = root.text_or("title", file.stem().string(), "the name of the file");
  SceneTable machine = root.table("machine");
  const std::string type = machine.has("type") ? machine.text("type") : "";
  if (type == "vibratory_mill")
    read_vibratory_mill_scene(root, machine, scene, findings);
  else if (type == "planetary_mill")
    read_planetary_mill_scene(root, machine, scene, findings);
  else if (type == "drive_train")
    read_drive_train_scene(root, machine, scene, findings);
  else if (type == "load_table")
    read_load_table_scene(root, machine, scene, findings);
  else {
    if (!machine.has("type"))
      machine.refuse_missing("type", "is missing; add it: one of " + machine_types);
    else if (!type.empty())
      machine.refuse("type", "unknown machine; write one of " + machine_types);
    for (const char* key :
         {"effects", "sampling", "bearings", "zones", "results", "tolerance", "time_limit", "method"})
      root.know(key);
    for (const auto& body : all_bodies()) root.know(body.first);
    root.finish();  // there may be no [machine] at all
    throw_sorted(findings.errors);
  }
  scene.sampling = read_sampling(root.table_or_empty("sampling"), scene, findings);

  std::vector<SceneTable> bodies;
  if (type == "drive_train") {
    if (!scene.bodies.empty()) bodies.push_back(root.table("shaft"));
  } else {
    bodies = read_bodies(root, type, scene, findings);
  }
  if (bodies.empty() && (root.has("zones") || root.has("results")))
    findings.warnings.push_back("without a body ([shaft], [chamber] ...) [zones] and [results] have no use");
  scene.bearings = read_bearings(root);
  scene.accuracy = read_requested_accuracy(root);
  scene.method = read_method(root, scene);
  scene.zones = read_zones(root.table_or_empty("zones"));
  read_results(root.table_or_empty("results"), scene);
  root.finish();

  if (findings.errors.empty()) rehearse(scene, root, machine, bodies);
  if (!findings.errors.empty()) throw_sorted(std::move(findings.errors));
  scene.defaults = std::move(findings.defaults);
  scene.warnings = std::move(findings.warnings);
  scene.known_keys.assign(findings.keys.begin(), findings.keys.end());
  for (auto& doubt : implausible(scene)) scene.warnings.push_back(std::move(doubt));
  return scene;
}

}  // namespace pipelines
