#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/scene_machine.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/write/machines/spring_report.h"

namespace pipelines {
namespace {

struct SpringsCommandOptions : SceneOptions {
  std::string least, most, most_transmitted;  ///< empty: not limited
  bool across_resonances = false;
  bool json = false;
};

std::optional<double> given_above_zero(const char* option, const std::string& text, const std::string& unit) {
  if (text.empty()) return std::nullopt;
  const double value = option_in_si(option, text, unit);
  if (!(value > 0)) throw OptionError(std::string(option) + " " + text + ": must be above 0");
  return value;
}

SpringLimits limits_of(const SpringsCommandOptions& options) {
  SpringLimits limits{
      given_above_zero("--least", options.least, "N/m"), given_above_zero("--most", options.most, "N/m"),
      given_above_zero("--most-transmitted", options.most_transmitted, "N"), options.across_resonances};
  if (limits.least_N_m && limits.most_N_m && *limits.least_N_m >= *limits.most_N_m)
    throw OptionError("--least " + options.least + ": must be below --most " + options.most);
  return limits;
}

void springs(const SpringsCommandOptions& options, std::ostream& out) {
  const auto limits = limits_of(options);
  Scene scene = read_scene(options.scene, options.settings);
  scene.machine = machine_with_masses(scene);
  print_spring_choice(out, scene, limits, options.json);
}

}  // namespace

void add_springs_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<SpringsCommandOptions>();
  auto* command = add_scene_command(app, "springs",
                                    "the stiffness that loads a vibratory mill's bearings least", *options);
  command->add_option("--least", options->least,
                      "vertical stiffness of all springs at least, like \"20 kN/m\"");
  command->add_option("--most", options->most, "vertical stiffness of all springs at most");
  command->add_option("--most-transmitted", options->most_transmitted,
                      "largest force of the springs on the ground, without the weights, like \"500 N\"");
  command->add_flag("--across-resonances", options->across_resonances,
                    "look beyond the resonances of the pitch next to the given springs, too");
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, springs));
}

}  // namespace pipelines
