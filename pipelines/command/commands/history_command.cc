#include <CLI/CLI.hpp>
#include <optional>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/command/commands/run_results.h"
#include "pipelines/command/options/output_files.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/files/stress_history_files.h"

namespace pipelines {
namespace {

struct HistoryCommandOptions : WantedRun {
  std::vector<std::string> at;
  std::filesystem::path output, results;  ///< empty: the default
  bool json = false;
};

void show_history(const HistoryCommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene, options.settings);
  if (scene.bodies.empty())
    throw StageRefused(scene.file.string() +
                       ": has no body, and only bodies have a stress; add one, as [shaft], to the scene");
  if (scene.keep == Keep::report)
    throw StageRefused(scene.file.string() +
                       ": keeps the report alone, and a history is made of the loads; give --set "
                       "'results.keep=\"results\"'");
  const auto variant = variant_of(options);
  const auto directory = own_directory(options.output, default_directory(options, "_history"), variant);
  std::string bodies;
  for (const auto& body : scene.bodies) bodies += (bodies.empty() ? "" : "|") + body.name;
  require_own_outputs(directory, names_like(R"(histories\.h5|()" + bodies + R"()_.+\.csv)"));
  std::optional<ToleranceNotMet> not_met;
  const auto results = results_directory(options.results, default_directory(options), variant);
  require_own_variant(results, variant, "--results");
  try {
    bring_up_to_date(options, results);
  } catch (const ToleranceNotMet& error) {
    not_met = error;
  }
  const auto histories = read_stress_histories(results, options.at);
  const auto files = stress_history_files(histories);
  StagedResults staged(directory, names_of(files), "-o", variant);
  write_stress_histories(staged.folder(), histories);
  staged.publish();
  print_stress_histories(out, histories, options.json);
  if (!options.json) print_files(out, directory, files);
  if (not_met) throw *not_met;
}

}  // namespace

void add_history_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<HistoryCommandOptions>();
  auto* command = add_scene_command(
      app, "history", "stress over the cycle at zones, weld toes and chosen points, as tables", *options);
  add_repeated_option(
      *command, "--at", options->at,
      "\"zone 1\", the name of a surface, port or weld toe, \"node 12\" or \"12, 0, -3 mm\", of "
      "one body as \"shaft/zone 1\"; may be repeated (default: all zones and weld toes)");
  command->add_option("-o,--output", options->output,
                      "directory for the histories (default: results/<scene>_history)");
  command->add_option("--results", options->results,
                      "directory of the run; it is run first unless nothing has changed (default: "
                      "results/<scene>)");
  add_force_option(*command, *options);
  add_run_options(*command, *options, chosen);
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, show_history));
}

}  // namespace pipelines
