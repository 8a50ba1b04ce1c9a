/// Scenes and tables of loads, as far as the load stage and its report, within this process.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/base/common/statistics.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/write/report/summary.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/kinds/scene_cases.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

std::string fault_of_loads(const kinetics::LoadHistory& loads) {
  for (const auto& quantity : loads.quantities)
    if (quantity.has_statistics && !quantity.values.isFinite().all()) return quantity.name + " is not finite";
  for (const auto& resultant : loads.resultants) {
    if (!resultant.total.isFinite().all()) return resultant.role + " is not finite";
    for (const auto& part : resultant.contributions)
      if (!part.load.isFinite().all())
        return loads.effects[part.effect] + " in " + resultant.role + " is not finite";
  }
  return "";
}

/// JSON has no word for what is not finite: null stands there.
std::string fault_of_summary(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  const auto loads = json.value("loads", nlohmann::json::object());
  for (const auto& [name, load] : loads.items())
    for (const char* figure : {"max", "min", "mean", "rms"})
      if (!load.at(figure).is_number()) return name + "." + figure + " is no number in the summary";
  return "";
}

}  // namespace

kinetics::TimeGrid few_instants(const pipelines::Scene& scene) {
  const bool is_table = pipelines::kind_of(scene.machine).has_samples();
  return {is_table ? scene.sampling.turns : std::min(scene.sampling.turns, 3), 16};
}

std::string fault_of_scene(const std::filesystem::path& file) {
  auto scene = pipelines::read_scene(file);
  if (!scene.masses_from_mesh.empty()) return "";  // no loads without a mesh
  scene.sampling = few_instants(scene);
  const auto loads = pipelines::load_stage(scene, scene.machine);
  if (auto fault = fault_of_loads(loads); !fault.empty()) return fault;
  std::vector<pipelines::BearingScene> bearings;  // those at a port of a body need its mesh
  if (scene.bodies.empty()) bearings = scene.bearings;
  const pipelines::RunReport report{scene, loads, {}, {}, {}, pipelines::bearing_lives(bearings, loads, {})};
  std::ostringstream told;
  pipelines::print_report(told, report);
  pipelines::print_full_report(told, report);
  if (pipelines::kind_of(scene.machine).is_torsional())
    pipelines::require_finite(pipelines::report_torsion(scene, scene.machine));
  return fault_of_summary(pipelines::summary_json(report));
}

Verdict scene_case(Mutator& random, const Place& place) {
  const auto& scenes = place.samples.scenes;
  const auto& scene = random.one_of(scenes);
  write_bytes(place / "belt_pull.csv", place.samples.sound_table);
  write_bytes(place / "scene.toml", random.damage(scene, Grammar::toml, random.one_of(scenes)));
  return judged(place.directory.string(), [&] { return fault_of_scene(place / "scene.toml"); });
}

Verdict table_case(Mutator& random, const Place& place) {
  const auto& tables = place.samples.tables;
  const auto& table = random.one_of(tables);
  write_bytes(place / "belt_pull.csv", random.damage(table, Grammar::csv, random.one_of(tables)));
  write_bytes(place / "scene.toml", place.samples.table_scene);
  return judged(place.directory.string(), [&] { return fault_of_scene(place / "scene.toml"); });
}

}  // namespace fuzz
