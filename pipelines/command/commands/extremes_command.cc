#include <CLI/CLI.hpp>

#include "pipelines/command/options/scene_machine.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/write/machines/mill_reports.h"

namespace pipelines {
namespace {

struct ExtremesCommandOptions : SceneOptions {
  bool json = false;
};

void extremes(const ExtremesCommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene, options.settings);
  scene.machine = machine_with_masses(scene);
  print_extremes(out, scene, options.json);
}

}  // namespace

void add_extremes_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<ExtremesCommandOptions>();
  auto* command = add_scene_command(
      app, "extremes", "a mill's loads over all angles: of drive and charge, or of the carrier", *options);
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, extremes));
}

}  // namespace pipelines
