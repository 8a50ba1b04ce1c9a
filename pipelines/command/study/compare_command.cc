#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <sstream>
#include <vector>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/names/typography.h"
#include "pipelines/command/commands/run_results.h"
#include "pipelines/command/options/output_files.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/study/comparison/comparison_report.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

struct CompareCommandOptions {
  std::vector<std::filesystem::path> runs;  ///< result directories, or scenes
  WantedRun wanted;                         ///< of the scenes
  std::filesystem::path output;             ///< empty: nothing is written
  bool json = false;
};

/// The run of a scene, which is run first unless its results are there.
/// @param not_met  takes what the run falls short of
ComparedRun run_of_scene(const CompareCommandOptions& options, const std::filesystem::path& scene,
                         std::optional<ToleranceNotMet>& not_met) {
  WantedRun wanted = options.wanted;
  wanted.scene = scene;
  const auto directory = results_directory({}, default_directory(wanted), variant_of(wanted));
  try {
    bring_up_to_date(wanted, directory);
  } catch (const ToleranceNotMet& error) {
    not_met = error;
  }
  return read_compared_run(directory, scene.string());
}

void compare(const CompareCommandOptions& options, std::ostream& out) {
  if (options.runs.size() < 2)
    throw OptionError("compare: takes two runs or more, as result directories or scenes");
  const auto names = names_like(R"(comparison\.(json|csv|html)|.+_[A-Z][0-9]*\.png)");
  if (!options.output.empty()) require_own_outputs(options.output, names);
  std::optional<ToleranceNotMet> not_met;
  std::vector<ComparedRun> runs;
  for (const auto& run : options.runs)
    runs.push_back(std::filesystem::is_directory(run)
                       ? read_compared_run(run, run.string())
                       : run_of_scene(options, file_of_scene(run.string()), not_met));
  const auto comparison = compare_runs(std::move(runs));
  std::vector<std::string> files;
  if (!options.output.empty()) {
    StagedResults staged(options.output, names);
    files = write_comparison(staged.folder(), comparison);
    staged.publish();
  }
  if (options.json) {
    out << comparison_json(comparison);
  } else {
    std::ostringstream table;
    print_comparison(table, comparison, options.wanted.verbosity() == Verbosity::verbose);
    out << (stdout_shows_utf8() ? typographic(table.str()) : table.str());
    if (!files.empty()) print_files(out, options.output, files);
  }
  if (not_met) throw *not_met;
}

}  // namespace

void add_compare_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<CompareCommandOptions>();
  auto* command = app.add_subcommand(
      "compare",
      "runs side by side: inputs that differ, figures, and whether their errors tell a difference");
  command
      ->add_option("runs", options->runs,
                   "result directories, or scenes, which are run first unless nothing has changed")
      ->required();
  command->add_option("-o,--output", options->output,
                      "directory for comparison.json, .csv and .html with pictures on one scale");
  add_run_options(*command, options->wanted, chosen);
  command->add_flag("-q,--quiet", options->wanted.quiet, "no progress");
  command->add_flag("-v,--verbose", options->wanted.verbose, "all places and loads");
  command->add_flag("--json", options->json, "print JSON instead of the tables");
  command->callback(to_choose(chosen, options, compare));
}

}  // namespace pipelines
