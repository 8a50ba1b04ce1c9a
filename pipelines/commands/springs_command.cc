#include <CLI/CLI.hpp>

#include "pipelines/command_options/scene_machine.h"
#include "pipelines/command_options/scene_options.h"
#include "pipelines/machine_reports/mill_reports.h"

namespace pipelines {
namespace {

struct SpringsCommandOptions : SceneOptions {
  bool json = false;
};

void springs(const SpringsCommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene, options.settings);
  scene.machine = machine_with_masses(scene);
  print_spring_choice(out, scene, options.json);
}

}  // namespace

void add_springs_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<SpringsCommandOptions>();
  auto* command = add_scene_command(app, "springs",
                                    "the stiffness that loads a vibratory mill's bearings least", *options);
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, springs));
}

}  // namespace pipelines
