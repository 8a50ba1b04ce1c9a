#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/disk/staging.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/study/accuracy/accuracy.h"
#include "pipelines/study/accuracy/accuracy_chart.h"
#include "pipelines/study/accuracy/accuracy_report.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/run_record.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

struct AccuracyCommandOptions : SceneOptions {
  std::filesystem::path output;       ///< directory; empty: the default
  std::string body;                   ///< empty: all
  std::string tolerance, time_limit;  ///< empty: the scene's, or the usual ones
  std::string reference;              ///< a known stress; empty: none
  bool grid_convergence = false;      ///< systematic meshes too
  int n_repeats = 1;                  ///< repeats of each run
  int n_threads = all_cores;
};

/// "; did you mean "shaft"?", or nothing.
std::string near_body(const AccuracyCommandOptions& options, const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name);
  const auto nearest = nearest_name(options.body, names);
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

AccuracyOptions study_options_of(const AccuracyCommandOptions& options, const Scene& scene) {
  AccuracyOptions study;
  study.n_threads = options.n_threads;
  study.n_repeats = options.n_repeats;
  study.grid_convergence = options.grid_convergence;
  if (!options.time_limit.empty()) study.time_limit_s = time_limit_option(options.time_limit);
  if (!options.tolerance.empty()) study.tolerance = tolerance_option(options.tolerance);
  if (!options.reference.empty()) {
    if (scene.bodies.size() > 1 && options.body.empty())
      throw OptionError("--reference " + options.reference + ": of which body? Add --body");
    study.reference_Pa = option_in_si("--reference", options.reference, "Pa");
    if (!(study.reference_Pa > 0))
      throw OptionError("--reference " + options.reference + ": must be positive; write a stress above 0");
  }
  if (!options.body.empty() && scene.body(options.body) == nullptr)
    throw OptionError("--body " + options.body + ": the scene has no such body" + near_body(options, scene));
  return study;
}

bool has_run(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / "summary.json") &&
         !read_run_record(directory / run_record_name).is_report_alone;
}

/// The page of the run beside which the study stands, if there is one, with the study in it.
void write_page(const std::filesystem::path& study) {
  const auto run = study.parent_path();
  finish_exchange(run);
  if (!has_run(run)) return;
  if (const auto check = check_manifest(run); check.is_mixed())
    std::cerr << "millstress: no report.html: " << check.text(run) << '\n';
  else
    publish_html_report(run, study);
}

std::vector<std::string> names_of_body(const std::string& name) {
  return {name + ".txt", name + ".csv", name + "_gci.csv", name + ".png"};
}

/// @throws OptionError if something that a study writes, the page of the run beside it too, is another's
void require_own_files(const std::filesystem::path& directory, const Scene& scene) {
  std::vector<std::string> names{"accuracy.h5"};
  for (const auto& body : scene.bodies)
    for (const auto& name : names_of_body(body.name)) names.push_back(name);
  require_own_outputs(directory, names_of(names));
  if (has_run(directory.parent_path()))
    require_own_outputs(directory.parent_path(), names_of({"report.html"}));
}

void accuracy(const AccuracyCommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene, options.settings);
  if (scene.bodies.empty())
    throw StageRefused(scene.file.string() +
                       ": has no body, and the load stage alone is exact; add one, as [shaft], to the scene");
  AccuracyOptions study_options = study_options_of(options, scene);
  const auto variant = variant_of(options);
  const auto directory = own_directory(options.output, default_directory(options), variant) / "accuracy";
  require_own_files(directory, scene);
  StageClock clock(progress_on_stderr(options.verbosity()));
  const fem::Environment environment(options.n_threads);
  std::vector<AccuracyStudy> studies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& name = scene.bodies[i].name;
    if (!options.body.empty() && name != options.body) continue;
    StagedResults staged(directory, names_of(names_of_body(name)), "-o", variant);
    studies.push_back(study_accuracy(scene, i, study_options, clock));
    std::ostringstream table;
    print_accuracy(table, studies.back());
    out << table.str();
    const auto folder = staged.folder();
    write_text_file(folder / (name + ".txt"), table.str());
    write_accuracy_csv(folder / (name + ".csv"), studies.back());
    if (studies.back().grid) write_grid_csv(folder / (name + "_gci.csv"), *studies.back().grid);
    if (!write_accuracy_chart(studies.back(), scene.title + ": what accuracy costs in time",
                              folder / (name + ".png")))
      std::cerr << "no chart: " << why_nothing_draws() << "; the CSV has the same figures\n";
    staged.publish();
  }
  StagedResults staged(directory, names_of({"accuracy.h5"}), "-o", variant);
  write_accuracy_h5(staged.folder() / "accuracy.h5", studies);
  staged.publish();
  write_page(directory);
  out << "\n  results in " << directory.string() << '\n';
}

}  // namespace

void add_accuracy_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<AccuracyCommandOptions>();
  auto* command = add_scene_command(
      app, "accuracy", "what accuracy costs in time: error against seconds, as table and chart", *options);
  add_results_option(*command, options->output);
  add_force_option(*command, *options);
  command->add_option("--body", options->body, "this body alone, like shaft");
  command->add_option("--tolerance", options->tolerance,
                      "what a run is chosen for (default: the scene's, or \"5 %\")");
  command->add_option("--time-limit", options->time_limit,
                      "for each body; models that do not end in time are named (default: \"120 s\")");
  command->add_option("--reference", options->reference,
                      "a known stress, like \"104.8 MPa\" (default: an overkill run)");
  command->add_flag("--gci", options->grid_convergence,
                    "three systematic meshes too: observed order and grid convergence index");
  command->add_option("--repeats", options->n_repeats, "of every run, for the spread of its seconds")
      ->check(CLI::Range(1, 100));
  add_threads_option(*command, options->n_threads, chosen);
  command->callback(to_choose(chosen, options, accuracy));
}

}  // namespace pipelines
