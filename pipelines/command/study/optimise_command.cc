#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <optional>

#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/names/units.h"
#include "pipelines/command/commands/run_results.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/study/sweep_charts.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/scene/whole/requested_method.h"
#include "pipelines/study/optimum/optimum_report.h"
#include "pipelines/study/optimum/scene_text.h"
#include "pipelines/study/sweep/sweep_files.h"
#include "pipelines/study/sweep/sweep_journal.h"
#include "pipelines/study/sweep/sweep_run.h"
#include "pipelines/study/sweep/whole_run.h"
#include "pipelines/study/variations/point_work.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

struct OptimiseCommandOptions : WantedRun {
  std::string minimise, maximise;
  std::vector<std::string> vary, keep;
  int n_evaluations = 60;
  std::filesystem::path output;
  bool loads_only = false, fresh = false, json = false;
};

OptimumRequest request_of(const OptimiseCommandOptions& options) {
  if (options.minimise.empty() == options.maximise.empty())
    throw OptionError("optimise: give either --minimise FIGURE or --maximise FIGURE");
  if (options.vary.empty()) throw OptionError("--vary: nothing is varied; write --vary \"KEY = A..B UNIT\"");
  const bool asks_for_solves =
      !options.tolerance.empty() || !options.time_limit.empty() || !options.method.empty();
  if (options.loads_only && asks_for_solves)
    throw OptionError("--loads: solves nothing; leave --tolerance, --time-limit and --method out");
  OptimumRequest request;
  request.maximises = options.minimise.empty();
  request.goal = request.maximises ? options.maximise : options.minimise;
  for (const auto& text : options.vary) request.variations.push_back(parse_range(text));
  for (const auto& text : options.keep) request.bounds.push_back(parse_bound(text));
  request.most_evaluations = options.n_evaluations;
  return request;
}

/// What is asked for; the default's tolerance has no limit of time, so that no clock decides on the path.
RequestedAccuracy accuracy_of(const OptimiseCommandOptions& options, const Scene& scene) {
  const auto asked = requested_search(options.tolerance, options.time_limit, scene.accuracy);
  if (asked.once || asked.any()) return asked;
  return {with_default(asked).tolerance, 0, false, false};
}

/// What an optimisation is about.
struct Optimisation {
  OptimumRequest request;
  std::vector<std::string> settings;  ///< settings of all points
  TomlNode tree;                      ///< tree of the scene as its file has it
  Scene scene;
  bool has_tolerance_option;
  SweepOptions sweep;
  Variant variant;
  std::filesystem::path directory;

  explicit Optimisation(const OptimiseCommandOptions& options)
      : request(request_of(options)),
        settings(options.settings),
        tree(read_scene_tree(options.scene)),
        scene(read_scene(options.scene, tree, settings)),
        has_tolerance_option(!options.tolerance.empty()) {
    if (!options.method.empty()) {
      scene.method = requested_method(options.method, scene);
      settings.push_back("method=" + options.method);
    }
    const auto figures = request.figures();
    const bool loads_only = options.loads_only || scene.bodies.empty();
    sweep = {options.scene, tree, settings, options.n_threads, loads_only, options.fresh};
    sweep.accuracy = accuracy_of(options, scene);
    sweep.whole_runs = true;
    sweep.fatigue = std::any_of(figures.begin(), figures.end(), is_of_fatigue);
    variant = variant_of(options);
    variant.sweep = {(request.maximises ? "--maximise " : "--minimise ") + request.goal};
    for (const auto& text : options.vary) variant.sweep->push_back("--vary " + text);
    for (const auto& text : options.keep) variant.sweep->push_back("--keep " + text);
    directory = own_directory(options.output, default_directory(options, "_optimum"), variant);
  }
};

/// The scene's own value where it has one in the range's unit, else the middle of the range.
double start_of(const Variation& variation, const std::map<std::string, std::string>& texts) {
  const auto& range = *variation.range;
  const double low = std::min(range.first, range.last), high = std::max(range.first, range.last);
  const auto own = texts.find(variation.keys().front());
  if (own != texts.end()) try {
      return std::clamp(to_si(own->second, variation.unit), low, high);
    } catch (const UnitError&) {  // a bare number in SI
    }
  return (low + high) / 2;
}

std::vector<double> starts_of(const Optimisation& optimisation) {
  auto tree = optimisation.tree;
  set_keys(tree, optimisation.settings, optimisation.sweep.scene);
  const auto texts = texts_by_key(tree);
  std::vector<double> starts;
  for (const auto& variation : optimisation.request.variations) starts.push_back(start_of(variation, texts));
  return starts;
}

/// Points that are computed one after the other, and kept for a call that goes on where this one ends. The
/// path is the same in each call, so what an earlier one has computed comes first.
class PointsOnPath {
public:
  PointsOnPath(const Optimisation& optimisation, const std::filesystem::path& directory, StageClock& clock)
      : optimisation_(optimisation),
        journal_(directory / "journal", journal_key("optimise", optimisation.sweep)),
        clock_(clock),
        is_new_(optimisation.sweep.fresh) {}

  SweepRow row(const SweepPoint& point, double tolerance) {
    if (!is_new_)
      if (auto known = journal_.known({optimisation_.request.variations, {point}}).front()) {
        keep(point, *known);
        return *std::move(known);
      }
    auto row = computed(point, tolerance);
    if (row.refused.empty()) {
      if (!is_new_) journal_.begin(plan_, {rows_.begin(), rows_.end()});
      is_new_ = true;
      journal_.append(point, row);
      journal_.flush();
    }
    keep(point, row);
    tell(point, row);
    return row;
  }

private:
  /// Mistakes of the scene end the first point; later ones are refused for them.
  SweepRow computed(const SweepPoint& point, double tolerance) {
    auto options = optimisation_.sweep;
    options.accuracy.tolerance = tolerance;
    auto own = point;
    const auto is_tolerance = [](const std::string& setting) { return setting.rfind("tolerance=", 0) == 0; };
    own.settings.erase(std::remove_if(own.settings.begin(), own.settings.end(), is_tolerance),
                       own.settings.end());
    SweepRow row;
    const auto run = [&] {
      SweepRun one(options, {own});
      if (rows_.empty() && one.has_chosen_effects())
        std::cerr
            << "millstress: effects = \"auto\" chooses by the point; an optimisation has all of them on\n";
      row = one.run(clock_, {}, [](const auto&, const auto&) {}).front();
    };
    if (rows_.empty())
      run();
    else if (const auto refused = point_refusal(run); !refused.empty())
      row.refused = refused;
    return row;
  }

  void keep(const SweepPoint& point, const SweepRow& row) {
    plan_.points.push_back(point);
    rows_.push_back(row);
  }

  void tell(const SweepPoint& point, const SweepRow& row) const {
    std::string text = fmt::format("point {}:", plan_.points.size());
    for (const auto& value : point.values) text += " " + value;
    if (!row.refused.empty())
      text += ": refused: " + row.refused.substr(0, row.refused.find('\n'));
    else
      for (const auto& figure : optimisation_.request.figures())
        text += ", " + figure + " " + figure_text(row, figure);
    clock_.note(text);
  }

  const Optimisation& optimisation_;
  SweepJournal journal_;
  StageClock& clock_;
  bool is_new_;  ///< the journal is this call's own
  SweepPlan plan_;
  std::vector<SweepRow> rows_;
};

/// The scene with the keys of the optimum.
void write_scene(const std::filesystem::path& file, const Optimisation& optimisation,
                 const Optimum& optimum) {
  auto settings = optimisation.settings;
  auto own = optimum.plan.points[optimum.best].settings;
  const auto sets_tolerance = [](const std::string& s) { return s.rfind("tolerance", 0) == 0; };
  const bool is_asked = optimisation.has_tolerance_option || optimum.levels[optimum.best] > 0;
  auto& others = is_asked ? settings : own;  // a run has its own default
  others.erase(std::remove_if(others.begin(), others.end(), sets_tolerance), others.end());
  settings.insert(settings.end(), own.begin(), own.end());
  auto tree = optimisation.tree;
  set_keys(tree, settings, optimisation.sweep.scene);
  write_text_file(file, "# " + optimisation.sweep.scene.filename().string() +
                            " as `millstress optimise` has left it. Its comments are not here.\n\n" +
                            toml_text(with_files_seen_from(optimisation.directory, std::move(tree),
                                                           optimisation.sweep.scene)));
}

/// @return the names of all files
std::vector<std::string> write_optimum(const std::filesystem::path& folder, const Optimisation& optimisation,
                                       const Optimum& optimum) {
  const auto& request = optimisation.request;
  std::vector<std::string> names{"optimum.csv", "optimum.json"};
  write_sweep_csv(folder / names[0], optimum.plan, optimum.rows, 1);
  write_text_file(folder / names[1], optimum_json(request, optimum));
  if (optimum.is_kept) {
    names.emplace_back("optimum.toml");
    write_scene(folder / names.back(), optimisation, optimum);
  }
  for (auto& chart : draw_charts(folder, optimisation.scene.title, optimum.plan, optimum.rows,
                                 request.figures(), SweepDesign::latin_hypercube))
    names.push_back(std::move(chart));
  return names;
}

void optimise(const OptimiseCommandOptions& options, std::ostream& out) {
  const Optimisation optimisation(options);
  const auto& request = optimisation.request;
  StageClock clock(progress_on_stderr(options.verbosity()));
  std::optional<fem::Environment> environment;  // it outlives the charts, as in a sweep
  StagedResults staged(optimisation.directory,
                       names_like(R"(optimum\.(csv|json|toml)|chart(_[0-9]+)?\.(png|svg))"), "-o",
                       optimisation.variant);
  require_own(staged.directory() / "journal", SweepJournal::is_journal, "-o");
  if (!optimisation.sweep.loads_only) environment.emplace(options.n_threads);
  PointsOnPath points(optimisation, staged.directory(), clock);
  const auto optimum = find_optimum(
      request,
      {starts_of(optimisation), optimisation.sweep.loads_only ? 0 : optimisation.sweep.accuracy.tolerance,
       [&](const SweepPoint& point, double tolerance) { return points.row(point, tolerance); }});
  const auto names = write_optimum(staged.folder(), optimisation, optimum);
  staged.publish();
  if (options.json) {
    out << optimum_json(request, optimum);
  } else {
    print_optimum(out, request, optimum);
    out << "\n ";
    for (const auto& name : names) out << (name == names.front() ? " " : ", ") << name;
    out << " in " << optimisation.directory.string() << '\n';
  }
  if (!optimum.is_kept) throw ToleranceNotMet(why_not_kept(request, optimum) + "; the path is kept");
}

}  // namespace

void add_optimise_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<OptimiseCommandOptions>();
  auto* command = add_scene_command(
      app, "optimise", "the values of a few keys by which a figure is least or largest within bounds",
      *options);
  command->add_option("--minimise", options->minimise, "figure that is to be least, as sweep.csv names it");
  command->add_option("--maximise", options->maximise, "figure that is to be largest");
  add_repeated_option(
      *command, "--vary", options->vary,
      "\"KEY = A..B UNIT\", or \"KEY, KEY = A..B UNIT\" for one value of several keys; may be "
      "repeated");
  add_repeated_option(*command, "--keep", options->keep,
                      "\"FIGURE >= VALUE UNIT\" or \"<=\", kept with the figure's error; may be repeated");
  command->add_option("--evaluations", options->n_evaluations, "points of the search at most (default: 60)")
      ->check(CLI::Range(2, 10'000));
  command->add_flag("--loads", options->loads_only, "the load stage alone, for figures of loads");
  command->add_option("-o,--output", options->output, "result directory (default: results/<scene>_optimum)");
  add_force_option(*command, *options);
  command->add_flag("--fresh", options->fresh, "reuse nothing of an earlier optimisation");
  command->add_flag("--json", options->json, "print optimum.json instead of the tables");
  add_run_options(*command, *options, chosen);
  command->callback(to_choose(chosen, options, optimise));
}

}  // namespace pipelines
