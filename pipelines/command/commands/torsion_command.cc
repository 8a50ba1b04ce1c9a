#include <CLI/CLI.hpp>
#include <optional>
#include <ostream>

#include "pipelines/command/options/output_files.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_machine.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/pictures/load_charts.h"

namespace pipelines {
namespace {

struct TorsionCommandOptions : SceneOptions {
  std::filesystem::path output;  ///< directory; empty: none
  bool json = false;
};

void torsion(const TorsionCommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene, options.settings);
  auto files = torsion_files();
  files.insert(files.end(), {"campbell.png", "campbell.svg", "modes.png", "modes.svg"});
  if (!options.output.empty()) require_own_variant(options.output, variant_of(options));
  std::optional<StagedResults> staged;
  if (!options.output.empty()) staged.emplace(options.output, names_of(files), "-o", variant_of(options));
  const TorsionReport report = report_torsion(scene, machine_with_masses(scene));
  std::vector<std::string> charts;
  if (staged) {
    write_torsion_files(staged->folder(), scene, report);
    charts = write_torsion_charts(staged->folder(), scene, report);
    staged->publish();
    say_if_nothing_draws(charts, !charts.empty() || make_offscreen_window());
  }
  if (options.json) {
    out << torsion_json(scene, report);
    return;
  }
  print_torsion(out, scene, report, options.verbosity() == Verbosity::verbose);
  for (const auto& warning : scene.warnings) out << "  warning: " << warning << '\n';
  print_files(out, options.output, charts);
}

}  // namespace

void add_torsion_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<TorsionCommandOptions>();
  auto* command = add_scene_command(
      app, "torsion", "natural frequencies, forced response and resonances of a drive train", *options);
  command->add_option("-o,--output", options->output,
                      "write modes, response, Campbell table to this directory");
  add_force_option(*command, *options);
  command->add_flag("--json", options->json, "print JSON instead of the tables");
  command->callback(to_choose(chosen, options, torsion));
}

}  // namespace pipelines
