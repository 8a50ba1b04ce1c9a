#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/output_files.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_machine.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/machines/free_body_report.h"
#include "pipelines/write/pictures/free_body_chart.h"

namespace pipelines {
namespace {

struct FreeBodyCommandOptions : SceneOptions {
  std::string at = "0 deg";
  std::filesystem::path output;
  bool json = false;
};

/// Turns of which a double still knows a millionth of a degree.
constexpr double most_turns = 1e6;

double angle_of(const std::string& at) {
  const double angle_rad = option_in_si("--at", at, "rad");
  if (std::abs(angle_rad) <= 2 * pi * most_turns) return angle_rad;
  throw OptionError("--at " + at +
                    ": is more than a million turns, where the angle within the turn gets lost; write it "
                    "between 0 and 360 deg");
}

void show_free_body(const FreeBodyCommandOptions& options, std::ostream& out) {
  const double angle_rad = angle_of(options.at);
  Scene scene = read_scene(options.scene, options.settings);
  scene.machine = machine_with_masses(scene);
  const auto body = free_body(scene);
  const std::vector<std::string> pictures{"free_body.png", "free_body.svg"};
  if (!options.output.empty()) require_own_variant(options.output, variant_of(options));
  std::optional<StagedResults> staged;
  if (!options.output.empty())
    staged.emplace(options.output, names_like(R"(free_body(\.(csv|pvd|png|svg)|_[0-9]{3,}\.vtp))"), "-o",
                   variant_of(options));
  const auto instant = instant_at(body, angle_rad);
  bool is_drawn = false;
  if (staged) {
    write_free_body(staged->folder(), scene, body);
    is_drawn = draw_free_body(scene, body, instant, staged->folder() / "free_body");
    staged->publish();
    say_if_nothing_draws(is_drawn ? pictures : std::vector<std::string>(), is_drawn);
  }
  print_free_body(out, scene, body, instant, options.json);
  if (options.json || options.output.empty()) return;
  std::vector<std::string> written{"free_body.csv", "free_body.pvd"};
  if (is_drawn) written.insert(written.end(), pictures.begin(), pictures.end());
  print_files(out, options.output, written);
}

}  // namespace

void add_free_body_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<FreeBodyCommandOptions>();
  auto* command = add_scene_command(
      app, "free-body", "a vibratory mill's chamber with all forces on it, at an angle and over the turn",
      *options);
  command->add_option("--at", options->at, "angle of the drive, clockwise, like \"45 deg\" (default: 0 deg)");
  command->add_option("-o,--output", options->output,
                      "directory for the picture, the table and the animation over the turn");
  add_force_option(*command, *options);
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback(to_choose(chosen, options, show_free_body));
}

}  // namespace pipelines
