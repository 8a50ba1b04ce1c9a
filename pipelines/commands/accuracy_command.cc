#include <iostream>
#include <sstream>

#include "pipelines/accuracy/accuracy.h"
#include "pipelines/accuracy/accuracy_report.h"
#include "pipelines/commands/commands.h"
#include "pipelines/commands/option_value.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/fem_environment.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/pictures/accuracy_chart.h"
#include "pipelines/report/html_report.h"

namespace pipelines {

void accuracy_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  if (scene.bodies.empty())
    throw StageRefused(scene.file.string() +
                       ": has no body, and the load stage alone is exact; add one, as [shaft], to the scene");
  AccuracyOptions study_options;
  study_options.n_threads = options.n_threads;
  study_options.n_repeats = options.n_repeats;
  study_options.grid_convergence = options.grid_convergence;
  if (!options.time_limit.empty())
    study_options.time_limit_s = option_in_si("--time-limit", options.time_limit, "s");
  if (!options.tolerance.empty())
    study_options.tolerance = option_in_si("--tolerance", options.tolerance, "1");
  if (!options.reference.empty()) {
    if (scene.bodies.size() > 1 && options.body.empty())
      throw OptionError("--reference " + options.reference + ": of which body? Add --body");
    study_options.reference_Pa = option_in_si("--reference", options.reference, "Pa");
  }
  if (!options.body.empty() && scene.body(options.body) == nullptr)
    throw OptionError("--body " + options.body + ": the scene has no such body");
  if (study_options.time_limit_s <= 0 || (!options.tolerance.empty() && study_options.tolerance <= 0))
    throw OptionError("--time-limit and --tolerance must be positive");

  const auto directory =
      (options.output.empty() ? std::filesystem::path("results") / scene.file.stem() : options.output) /
      "accuracy";
  StageClock clock(progress_on_stderr(options.verbosity));
  const FemEnvironment environment(options.n_threads);
  std::vector<AccuracyStudy> studies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& name = scene.bodies[i].name;
    if (!options.body.empty() && name != options.body) continue;
    study_options.directory = directory / name;
    studies.push_back(study_accuracy(scene, i, study_options, clock));
    std::ostringstream table;
    print_accuracy(table, studies.back());
    out << table.str();
    write_text_file(directory / (name + ".txt"), table.str());
    write_accuracy_csv(directory / (name + ".csv"), studies.back());
    if (studies.back().grid) write_grid_csv(directory / (name + "_gci.csv"), *studies.back().grid);
    if (!write_accuracy_chart(studies.back(), scene.title + ": what accuracy costs in time",
                              directory / (name + ".png")))
      std::cerr << "no chart: this machine offers no EGL (package libegl1); the CSV has the same figures\n";
    std::error_code ignored;
    std::filesystem::remove(study_options.directory, ignored);
  }
  write_accuracy_h5(directory / "accuracy.h5", studies);
  if (std::filesystem::exists(directory.parent_path() / "summary.json"))
    write_html_report(directory.parent_path());
  out << "\n  results in " << directory.string() << '\n';
}

}  // namespace pipelines
