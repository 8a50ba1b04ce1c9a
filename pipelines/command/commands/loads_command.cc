#include <CLI/CLI.hpp>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "fem/models/solid/model.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/command/calculix/calculix_cards.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/output_files.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/loads/channels/load_files.h"
#include "pipelines/loads/channels/load_statistics.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/study/effects/body_effect_report.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/pictures/load_charts.h"
#include "pipelines/write/report/summary.h"

namespace pipelines {
namespace {

/// Files to write; empty: none.
struct LoadsCommandOptions : SceneOptions {
  std::filesystem::path output;  ///< .h5
  std::filesystem::path csv;
  std::filesystem::path statistics;  ///< directory
  std::filesystem::path calculix;    ///< prefix of the files of cards
  bool json = false;
};

/// Whether the loads of a scene cannot be told without its bodies' meshes: masses come from there, or effects
/// are to be chosen by what the bodies feel.
bool needs_meshes(const Scene& scene) {
  return !scene.bodies.empty() && (!scene.masses_from_mesh.empty() || scene.effect_choice.open);
}

/// The load stage, with the effects that the scene's bodies leave on and the masses that they have. What is
/// meshed for that has to be in equilibrium, too.
/// @param scene  on return with its effects chosen
kinetics::LoadHistory loads_of(Scene& scene, StageClock& clock) {
  const double limit = negligible_share(scene.accuracy.tolerance);
  if (!needs_meshes(scene)) {
    if (scene.bodies.empty()) scene = with_effects_chosen(std::move(scene), {}, limit);
    return clock.run("loads", [&] { return load_stage(scene, scene.machine); });
  }
  const fem::Environment environment(all_cores);
  const auto meshed = clock.run("mesh", [&] { return mesh_bodies(scene); });
  scene = clock.run("effects", [&] { return with_effects_chosen(std::move(scene), meshed, limit); });
  const auto masses = agree_masses(scene, meshed);
  auto trial = clock.run("loads", [&] { return try_effects(scene, meshed, masses); });
  require_equilibrium(scene, meshed, masses, trial.bodies);
  scene.machine = masses.machine;  // a report must not take what stands for its masses until then
  return std::move(trial.history);
}

const std::vector<std::string>& statistics_files() {
  static const std::vector<std::string> names{
      "statistics.csv", "harmonics.csv", "polar.csv",     "spectrum.csv",  "histories.png", "histories.svg",
      "polar.png",      "polar.svg",     "harmonics.png", "harmonics.svg", "rainflow.png",  "rainflow.svg"};
  return names;
}

void require_outputs(const LoadsCommandOptions& options) {
  auto all = output_files("--statistics", options.statistics, statistics_files());
  const auto add = [&](const char* option, const std::filesystem::path& file, const IsOwnFile& is_own) {
    if (file.empty()) return;
    require_own(file, is_own, option);
    all.push_back({option, file});
  };
  add("--output", options.output, is_loads_file);
  add("--csv", options.csv, is_loads_file);
  for (const auto& file : calculix_card_files(options.calculix)) add("--calculix", file, is_calculix_cards);
  require_different(all);
}

void loads(const LoadsCommandOptions& options, std::ostream& out) {
  require_extension(
      "--output", options.output, {".h5", ".hdf5", ".hdf"},
      "is written as HDF5; for a table write --csv " + options.output.string() + ", or end the name in .h5");
  require_extension(
      "--csv", options.csv, {".csv", ".txt"},
      "is written as CSV; for HDF5 write -o " + options.csv.string() + ", or end the name in .csv");
  Scene scene = read_scene(options.scene, options.settings);
  require_outputs(options);
  std::optional<StagedResults> statistics;
  if (!options.statistics.empty()) {
    require_own_variant(options.statistics, variant_of(options), "--statistics");
    statistics.emplace(options.statistics, names_of(statistics_files()), "--statistics", variant_of(options));
  }
  StageClock clock(progress_on_stderr(options.verbosity()));
  auto history = loads_of(scene, clock);
  std::vector<BearingScene> bearings;  // bearings at a port of a body need `run`
  for (const auto& bearing : scene.bearings)
    if (scene.bodies.empty() || force_of(bearing.load, history, {})) bearings.push_back(bearing);
  const auto lives = bearing_lives(bearings, history, {});
  warn_beyond_ratings(bearings, lives, history);
  const auto write_own = [&](const std::filesystem::path& file, auto write) {
    if (file.empty()) return;
    AtomicFile whole(file, is_loads_file);
    clock.run("write", [&] { write(whole.temporary(), history); });
    whole.commit();
  };
  write_own(options.output, [](const auto& file, const auto& loads) { write_loads_h5(file, loads); });
  write_own(options.csv, [](const auto& file, const auto& loads) { write_loads_csv(file, loads); });
  std::vector<std::string> charts;
  if (statistics) {
    const int turns = scene.run_up ? 0 : scene.sampling.turns;
    clock.run("write", [&] {
      write_statistics(statistics->folder(), history, turns, course_of_loads(scene, history));
    });
    charts = clock.run("charts",
                       [&] { return write_load_charts(statistics->folder(), scene.title, history, turns); });
    say_if_nothing_draws(charts, !charts.empty() || make_offscreen_window());
    statistics->publish();
  }
  if (!options.calculix.empty())
    clock.run("write", [&] { write_calculix_cards(options.calculix, history, !scene.run_up); });
  const RunReport content{scene, history, {}, {}, clock.costs(), lives};
  if (options.json) {
    out << with_effects_of_bodies(summary_json(content), scene);
  } else {
    print_report(out, content);
    print_effects_of_bodies(out, scene, options.verbosity() == Verbosity::verbose);
    print_files(out, options.statistics, charts);
  }
}

}  // namespace

void add_loads_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<LoadsCommandOptions>();
  auto* command = add_scene_command(app, "loads", "the load stage alone", *options);
  command->add_option("-o,--output", options->output, "write the load history to this HDF5 file");
  command->add_option("--csv", options->csv, "write the load history to this CSV file");
  command->add_option(
      "--statistics", options->statistics,
      "write extremes, harmonics, polar plots and load spectra to this directory, as tables and charts");
  command->add_option("--calculix", options->calculix,
                      "write PREFIX_amplitudes.inp and PREFIX_loads.inp for CalculiX");
  add_force_option(*command, *options);
  command->add_flag("--json", options->json, "print the summary as JSON instead of the table");
  command->callback(to_choose(chosen, options, loads));
}

}  // namespace pipelines
