#include <CLI/CLI.hpp>
#include <ostream>

#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/scene_machine.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/effect_choice/effect_report.h"
#include "pipelines/study/effects/body_effect_report.h"

namespace pipelines {
namespace {

struct EffectsCommandOptions : SceneOptions {
  std::string threshold;  ///< what may change when effects are left out; empty: the usual
  bool json = false;
};

/// 1 %; with effects = "auto" what the scene allows.
double usual_threshold(const Scene& scene) {
  return scene.effect_choice.open ? negligible_share(scene.accuracy.tolerance) : 0.01;
}

void effects(const EffectsCommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene, options.settings);
  scene.machine = machine_with_masses(scene);
  const double threshold = options.threshold.empty() ? usual_threshold(scene)
                                                     : option_in_si("--threshold", options.threshold, "1");
  const EffectReport worth = report_effects(scene, threshold);
  if (options.json) {
    out << with_effects_of_bodies(effects_json(scene, worth), scene);
    return;
  }
  const bool all = options.verbosity() == Verbosity::verbose;
  print_effects(out, scene, worth, all);
  print_effects_of_bodies(out, scene, all);
  if (scene.effect_choice.open && !scene.bodies.empty())
    out << "  effects = \"auto\" is judged by the loads on the bodies in a run; `check` lists what goes\n";
}

}  // namespace

void add_effects_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<EffectsCommandOptions>();
  auto* command = add_scene_command(
      app, "effects", "each effect's share of the loads, what leaving it out changes, what it costs",
      *options);
  command->add_option(
      "--threshold", options->threshold,
      "what may change when effects are left out (default: \"1 %\"; with effects = \"auto\" a tenth "
      "of the tolerance)");
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, effects));
}

}  // namespace pipelines
