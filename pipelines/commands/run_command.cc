#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "fem/ranks/helper_ranks.h"
#include "pipelines/accuracy/cost_calibration.h"
#include "pipelines/accuracy/cost_forecast.h"
#include "pipelines/analysis/body_analysis.h"
#include "pipelines/analysis/error_text.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/commands/option_value.h"
#include "pipelines/commands/scene_options.h"
#include "pipelines/common/failure.h"
#include "pipelines/common/fem_environment.h"
#include "pipelines/effects/effect_choice.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/loads/load_files.h"
#include "pipelines/loads/load_stage.h"
#include "pipelines/pictures/picture.h"
#include "pipelines/report/envelope_files.h"
#include "pipelines/report/html_report.h"
#include "pipelines/report/results.h"
#include "pipelines/report/staged_results.h"
#include "pipelines/report/summary.h"
#include "pipelines/report/torsion_report.h"
#include "pipelines/scene/machine_kind.h"
#include "pipelines/scene/requested_method.h"
#include "pipelines/search/scene_run.h"

namespace pipelines {
namespace {

struct RunCommandOptions : SceneOptions {
  std::filesystem::path output;               ///< directory; empty: the default
  std::string tolerance, time_limit, method;  ///< empty: the scene's
  int n_threads = all_cores;
  bool fresh = false;
  bool json = false;
};

/// The envelope as a picture that marks the governing stress; a machine that cannot draw gets a line instead.
/// @param envelope  the .vtu
void draw(const std::filesystem::path& envelope, const std::filesystem::path& directory,
          const std::string& title, const BodyAnalysis& analysis) {
  const auto stress = governing_stress(analysis);
  PictureOptions options;
  options.scale = 1e-6;
  options.excluded = excluded_field;
  options.mark = PictureMark{stress.position_m, fmt::format("{} {} MPa\n{}", stress.name(),
                                                            fixed(stress.value_Pa / 1e6, 1), stress.place)};
  if (!write_picture(envelope, pictured_field(analysis),
                     title + ", " + analysis.scene.name + ": largest von Mises stress over the cycle", "MPa",
                     directory / "envelope.png", options))
    std::cerr << "no picture: this machine offers no EGL (package libegl1); envelope.vtu opens in ParaView\n";
}

void finish_run(const RunCommandOptions& options, std::ostream& out, const std::filesystem::path& directory,
                StagedResults& staged, const RunReport& content) {
  write_text_file(staged.folder() / "summary.json", summary_json(content));
  write_html_report(staged.folder(), directory / "accuracy");
  staged.publish();
  if (options.json)
    out << summary_json(content);
  else
    print_report(out, content);
}

RequestedAccuracy requested_accuracy_of(const RunCommandOptions& options, const Scene& scene) {
  return requested_search(options.tolerance, options.time_limit, scene.accuracy);
}

/// The scene with the masses that it leaves to a mesh: a report must not take what stands for them until
/// then.
Scene with_machine(Scene scene, const Machine& machine) {
  scene.machine = machine;
  return scene;
}

/// Says it at once, and in the results.
void warn(kinetics::LoadHistory& loads, const std::string& text) {
  std::cerr << "millstress: " << text << '\n';
  loads.warnings.push_back(text);
}

std::vector<std::string> body_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name);
  return names;
}

void warn_of_earlier(const StagedResults& staged) {
  if (!staged.warning().empty()) std::cerr << "millstress: " << staged.warning() << '\n';
}

/// Of a drive train, written into the folder torsion; nothing for other machines.
std::optional<TorsionReport> torsion_of(const Scene& scene, const Machine& machine,
                                        const std::filesystem::path& directory, StageClock& clock) {
  if (!kind_of(machine).is_torsional()) return std::nullopt;
  auto torsion = clock.run("torsion", [&] { return report_torsion(scene, machine); });
  clock.run("write", [&] { write_torsion_files(directory / "torsion", scene, torsion); });
  return torsion;
}

void run_load_stage(const RunCommandOptions& options, std::ostream& out, const Scene& given,
                    const std::filesystem::path& directory, StageClock& clock) {
  const double tolerance = requested_accuracy_of(options, given).tolerance;
  const Scene scene = with_effects_chosen(given, {}, negligible_share(tolerance));
  const auto loads = clock.run("loads", [&] { return load_stage(scene, scene.machine); });
  const auto lives = bearing_lives(scene.bearings, loads, {});
  StagedResults staged(directory, {});
  warn_of_earlier(staged);
  clock.run("write", [&] { write_load_results(staged.folder(), loads, {}); });
  const auto torsion = torsion_of(scene, scene.machine, staged.folder(), clock);
  finish_run(options, out, directory, staged, {scene, loads, {}, {}, clock.costs(), lives});
  if (options.json) return;
  if (torsion) print_torsion(out, scene, *torsion);
  out << "\n  results in " << directory.string() << '\n';
}

/// The default's minute was up before its tolerance was met: told loudly, but no failure, since nobody asked.
void warn_of_default(SceneRun& run) {
  for (const auto& analysis : run.analyses) {
    if (analysis.search.met) continue;
    const auto stress = governing_stress(analysis);
    const auto text = fmt::format(
        "{}: {:.3g} MPa is known to {:.2g} % only, since {}; the default is 5 % within 60 s. Give "
        "--time-limit or --tolerance for another",
        analysis.scene.name, stress.value_Pa / 1e6, 100 * stress.relative_error(), analysis.search.ended);
    warn(run.loaded.loads, text);
  }
}

/// Damaged files of an earlier run, each once: the last solve of every body has met those that matter.
void warn_of_damage(SceneRun& run) {
  for (const auto& analysis : run.analyses)
    for (const auto& text : analysis.warnings) warn(run.loaded.loads, text);
  if (const auto fault = read_calibration(calibration_file()).fault; !fault.empty())
    std::cerr << "millstress: " << fault << '\n';
}

void run_bodies(const RunCommandOptions& options, std::ostream& out, const Scene& scene,
                const std::filesystem::path& directory, StageClock& clock) {
  const auto accuracy = with_default(requested_accuracy_of(options, scene));
  const FemEnvironment environment(options.n_threads);
  StagedResults staged(directory, body_names(scene));
  warn_of_earlier(staged);
  auto run = run_scene(scene, {directory, options.n_threads, options.fresh, true, accuracy}, clock);
  warn_of_damage(run);
  learn_from(run);
  if (accuracy.by_default) warn_of_default(run);
  const auto& loads = run.loaded.loads;
  const auto channels = run.loaded.channels();
  for (const auto& analysis : run.analyses) {
    const auto place = staged.folder() / analysis.scene.name;
    const int n_ranks = fem::n_ranks(MPI_COMM_WORLD);
    clock.run("write", [&] { write_body_results(place, run.scene, loads, analysis, n_ranks); });
    if (!scene.pictures) continue;
    clock.run("pictures", [&] {
      if (n_ranks == 1) return draw(place / "envelope.vtu", place, scene.title, analysis);
      const AtomicFile whole(place / "envelope_whole.vtu");  // not kept
      write_whole_envelope(whole.temporary(), run.scene, loads, analysis);
      draw(whole.temporary(), place, scene.title, analysis);
    });
  }
  clock.run("write", [&] { write_load_results(staged.folder(), loads, channels); });
  const Scene reported = with_machine(run.scene, run.loaded.masses.machine);
  const auto torsion = torsion_of(reported, reported.machine, staged.folder(), clock);
  finish_run(options, out, directory, staged,
             {reported, loads, run.analyses, run.loaded.masses.figures, clock.costs(), run.loaded.bearings});
  if (!options.json && torsion) print_torsion(out, reported, *torsion);
  if (!options.json) out << "\n  results in " << directory.string() << '\n';
  if (!run.met() && !accuracy.by_default)
    throw ToleranceNotMet("the tolerance is not met; the results are kept");
}

void run(const RunCommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene, options.settings);
  scene.method = requested_method(options.method, scene);
  const auto directory = results_directory(options.output, scene);
  StageClock clock(progress_on_stderr(options.verbosity()));
  (scene.bodies.empty() ? run_load_stage : run_bodies)(options, out, scene, directory, clock);
}

}  // namespace

void add_run_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<RunCommandOptions>();
  auto* command =
      add_scene_command(app, "run", "everything: loads, mesh, stresses, zones, results", *options);
  add_results_option(*command, options->output);
  add_threads_option(*command, options->n_threads, chosen);
  command->add_option("--tolerance", options->tolerance,
                      "refine until the stress is known this well, like \"2 %\" (default: the scene's)");
  command->add_option("--time-limit", options->time_limit,
                      "stop refining in time, like \"60 s\" (default: the scene's)");
  command->add_option("--method", options->method,
                      "model of every body: auto, beam, axisymmetric or solid (default: the scene's)");
  command->add_flag("--fresh", options->fresh, "reuse nothing of an earlier run");
  command->add_flag("--json", options->json, "print summary.json instead of the table");
  command->callback(to_choose(chosen, options, run));
}

}  // namespace pipelines
