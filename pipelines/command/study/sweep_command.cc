#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fem/mesh/ranks/ranks.h"
#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/study/sweep_charts.h"
#include "pipelines/command/study/sweep_command_options.h"
#include "pipelines/command/study/sweep_table.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/respond/responses/response_key.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/scene/whole/requested_method.h"
#include "pipelines/study/sweep/points_on_ranks.h"
#include "pipelines/study/sweep/sweep_files.h"
#include "pipelines/study/sweep/sweep_journal.h"
#include "pipelines/study/sweep/sweep_run.h"
#include "pipelines/study/sweep/whole_run.h"
#include "pipelines/study/variations/sweep_request.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

void refuse_without_use(bool is_given, const char* option, const char* why) {
  if (is_given) throw OptionError(std::string(option) + ": has no use " + why + "; leave it out");
}

SweepRequest requested(const SweepCommandOptions& options, SweepRequest request) {
  if (!options.vary.empty()) request.vary = options.vary;
  if (!options.figures.empty()) request.figures = options.figures;
  if (!options.design.empty()) request.design = sweep_design(options.design);
  if (options.n_points > 0) request.n_points = options.n_points;
  if (options.seed >= 0) request.seed = std::uint64_t(options.seed);
  const bool is_drawn = request.design == SweepDesign::latin_hypercube;
  refuse_without_use(!is_drawn && options.n_points > 0, "--points", "without --design latin-hypercube");
  refuse_without_use(!is_drawn && options.seed >= 0, "--seed", "without --design latin-hypercube");
  constexpr const char* with_loads = "with --loads, which solves nothing";
  refuse_without_use(options.loads_only && options.zones, "--zones", with_loads);
  refuse_without_use(options.loads_only && !options.tolerance.empty(), "--tolerance", with_loads);
  refuse_without_use(options.loads_only && !options.time_limit.empty(), "--time-limit", with_loads);
  refuse_without_use(options.loads_only && !options.method.empty(), "--method", with_loads);
  request.zones = (request.zones || options.zones) && !options.loads_only;
  return request;
}

/// Whether a key is that of a table or list, or of something in it.
bool is_within(const std::string& key, const std::string& table) {
  return key.compare(0, table.size(), table) == 0 &&
         (key.size() == table.size() || key[table.size()] == '.' || key[table.size()] == '[');
}

/// No figure of a sweep depends on these keys: points that look alike would be no answer.
/// @param with_fatigue  fatigue and operating blocks are judged at every point
/// @param loads_only    nothing is solved
void require_swept(const std::string& key, bool with_zones, bool with_fatigue, bool loads_only) {
  if (is_within(key, "method") && loads_only)
    throw OptionError("--vary " + key +
                      ": no figure of loads depends on this; leave it out, or sweep a scene with a body "
                      "without --loads");
  for (const char* of_all : {"tolerance", "time_limit"})
    if (is_within(key, of_all))
      throw OptionError(
          "--vary " + key +
          ": one search serves many points, so that all have one tolerance and one time limit; "
          "run the scene with --set for each value, or compare models by `millstress accuracy`");
  for (const char* shown : {"title", "results", "sweep"})
    if (is_within(key, shown))
      throw OptionError("--vary " + key + ": no figure of a sweep depends on this; leave it out");
  if (is_within(key, "zones") && !with_zones)
    throw OptionError("--vary " + key +
                      ": no figure depends on this without the zones of every point; add --zones");
  const auto dot = key.find('.');
  if (with_fatigue) return;
  if (is_within(key, "duty") || (dot != std::string::npos && is_within(key.substr(dot + 1), "fatigue")))
    throw OptionError(
        "--vary " + key +
        ": this sweep judges no fatigue and no operating blocks, so that no figure depends on this; name one "
        "that does, like --figure bodies.shaft.fatigue.safety");
}

void tell_forecast(const SweepForecast& forecast, std::size_t n_known, const RequestedAccuracy& accuracy) {
  std::string text =
      fmt::format("millstress: {} point{}", forecast.n_points, forecast.n_points == 1 ? "" : "s");
  if (n_known > 0) text += fmt::format(", {} known from the sweep before", n_known);
  for (const auto& body : forecast.bodies)
    text += fmt::format("; {}: {} mesh{}, {} solution{}", body.name, body.n_meshes,
                        body.n_meshes == 1 ? "" : "es", body.n_solutions, body.n_solutions == 1 ? "" : "s");
  std::size_t n_meshes = 0;
  for (const auto& body : forecast.bodies) n_meshes += body.n_meshes;
  if (n_meshes > 0 && accuracy.time_limit_s > 0)
    text += fmt::format("; searching takes {:g} s at most", double(n_meshes) * accuracy.time_limit_s);
  std::cerr << text << '\n';
}

/// Points whose governing stress is known less well than the tolerance asks.
std::size_t n_known_worse(const std::vector<SweepRow>& rows, double tolerance) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), [&](const SweepRow& row) {
    return std::any_of(row.figures.begin(), row.figures.end(), [&](const auto& f) {
      return is_governing(f.name) && row.figure(f.name + ".error") > tolerance * f.value;
    });
  }));
}

/// The settings that concern operating blocks, or all others.
std::vector<std::string> settings_of_duty(const std::vector<std::string>& settings, bool of_duty) {
  std::vector<std::string> chosen;
  for (const auto& setting : settings)
    if (is_within(setting.substr(0, setting.find('=')), "duty") == of_duty) chosen.push_back(setting);
  return chosen;
}

/// The scene without operating blocks, on which no figure of a sweep depends.
/// @throws SceneError where a setting finds no such block
TomlNode tree_without_duty(const SweepCommandOptions& options) {
  TomlNode tree = read_scene_tree(options.scene);
  set_keys(tree, settings_of_duty(options.settings, true), options.scene);
  return without_duty(std::move(tree));
}

/// All files of a sweep but its journal, which knows itself.
OutputNames sweep_names() {
  return names_like(R"(sweep\.(csv|h5)|zones\.csv|(chart|map)(_[0-9]+)?\.(png|svg))");
}

/// What the command line says that is swept, each as it is written there.
std::vector<std::string> asked_on_command_line(const SweepCommandOptions& options) {
  std::vector<std::string> asked;
  for (const auto& variation : options.vary) asked.push_back("--vary " + variation);
  if (!options.design.empty()) asked.push_back("--design " + options.design);
  if (options.n_points > 0) asked.push_back("--points " + std::to_string(options.n_points));
  if (options.seed >= 0) asked.push_back("--seed " + std::to_string(options.seed));
  if (options.loads_only) asked.emplace_back("--loads");
  return asked;
}

/// The options of an earlier sweep.
/// @param asked  what asked_on_command_line gives
/// @throws std::exception where a number is none
SweepCommandOptions options_of(const std::vector<std::string>& asked) {
  SweepCommandOptions options;
  for (const auto& text : asked) {
    const auto space = std::min(text.find(' '), text.size());
    const auto name = text.substr(0, space), value = text.substr(std::min(space + 1, text.size()));
    if (name == "--vary") options.vary.push_back(value);
    if (name == "--design") options.design = value;
    if (name == "--points") options.n_points = std::stoi(value);
    if (name == "--seed") options.seed = std::stol(value);
    if (name == "--loads") options.loads_only = true;
  }
  return options;
}

/// Whether a sweep has every point of an earlier one of the scene, and its figures: it then adds to that one.
/// @param plan       plan of the sweep
/// @param of_scene   what the scene says of sweeps
/// @param asked      asked_on_command_line of the earlier one
bool has_points_of(const SweepPlan& plan, bool loads_only, const SweepRequest& of_scene,
                   const std::vector<std::string>& asked) {
  try {
    const auto earlier = options_of(asked);
    if (loads_only && !earlier.loads_only) return false;
    std::set<std::vector<std::string>> own;
    for (const auto& point : plan.points) own.insert(point.settings);
    const auto points = plan_sweep(requested(earlier, of_scene)).points;
    return std::all_of(points.begin(), points.end(),
                       [&](const SweepPoint& point) { return own.count(point.settings) > 0; });
  } catch (const std::exception&) {  // the scene's own part of it is another by now
    return false;
  }
}

/// The settings of all points, but for --method, which stands for `--set method`.
/// @param with_duty  settings of operating blocks are among them
std::vector<std::string> settings_of_points(const SweepCommandOptions& options, bool with_duty) {
  auto settings = with_duty ? options.settings : settings_of_duty(options.settings, false);
  const auto is_method = [](const std::string& setting) {
    return setting.substr(0, setting.find_first_of(" =")) == "method";
  };
  if (!options.method.empty())
    settings.erase(std::remove_if(settings.begin(), settings.end(), is_method), settings.end());
  return settings;
}

/// What a sweep is about, the same on all ranks.
struct Sweep {
  TomlNode tree;
  std::vector<std::string> settings;  ///< settings of all points
  SweepRequest request;
  SweepPlan plan;
  Variant variant;
  std::filesystem::path directory;
  Scene first;  ///< for what all points have alike
  RequestedAccuracy accuracy;
  bool loads_only;
  bool with_fatigue = false;  ///< fatigue is asked for: every point is a run

  explicit Sweep(const SweepCommandOptions& options)
      : tree(tree_without_duty(options)),
        settings(settings_of_points(options, false)),
        request(requested(options, read_sweep_request(options.scene, tree))),
        plan(plan_sweep(request)) {
    with_fatigue = std::any_of(request.figures.begin(), request.figures.end(), is_of_fatigue);
    if (with_fatigue) {
      tree = read_scene_tree(options.scene);
      settings = settings_of_points(options, true);
    }
    for (const auto& variation : plan.variations)
      refuse_without_use(!options.method.empty() && is_within(variation.key, "method"), "--method",
                         "where --vary chooses it");
    try {
      first = read_scene(options.scene, tree, settings);
    } catch (const SceneError&) {
      auto of_first = settings;
      const auto& own = plan.points.front().settings;
      of_first.insert(of_first.end(), own.begin(), own.end());
      first = read_scene(options.scene, tree, of_first);
    }
    if (!options.method.empty()) {
      first.method = requested_method(options.method, first);
      settings.push_back("method=" + options.method);
    }
    accuracy = with_default(requested_search(options.tolerance, options.time_limit, first.accuracy));
    loads_only = options.loads_only || first.bodies.empty();
    for (const auto& variation : plan.variations)
      for (const auto& key : variation.keys()) require_swept(key, request.zones, with_fatigue, loads_only);
    variant = variant_of(options);
    variant.sweep = asked_on_command_line(options);
    variant.has_all_of = [this, of_scene = read_sweep_request(options.scene, tree)](const auto& asked) {
      return has_points_of(plan, loads_only, of_scene, asked);
    };
    directory = own_directory(options.output, default_directory(options, "_sweep"), variant);
  }
  Sweep(const Sweep&) = delete;  // the variant refers to it
  Sweep& operator=(const Sweep&) = delete;

  SweepOptions options(const SweepCommandOptions& asked, int n_threads) const {
    return {asked.scene, tree,          settings,     n_threads,    loads_only,
            asked.fresh, request.zones, with_fatigue, with_fatigue, accuracy};
  }
};

/// Whether a rank computes a point, by rank and point. The same on all ranks.
std::vector<std::vector<char>> points_of_ranks(const SweepRun& run) {
  const int n_ranks = fem::n_ranks(MPI_COMM_WORLD);
  const auto rank_of_point = deal_points(run.groups(n_ranks), n_ranks);
  std::vector<std::vector<char>> is_own(std::size_t(n_ranks), std::vector<char>(rank_of_point.size(), 0));
  for (std::size_t p = 0; p < rank_of_point.size(); ++p) is_own[std::size_t(rank_of_point[p])][p] = 1;
  return is_own;
}

void tell_ranks(const std::vector<std::vector<char>>& points_of_ranks) {
  std::string text = "millstress: points by rank:";
  bool has_idle = false;
  for (const auto& is_own : points_of_ranks) {
    const auto n = std::count(is_own.begin(), is_own.end(), 1);
    text += fmt::format(" {}", n);
    has_idle = has_idle || n == 0;
  }
  std::cerr << text << (has_idle ? "; points that share their meshes stay on one rank" : "") << '\n';
}

/// Threads of this rank.
int own_threads(const SweepCommandOptions& options) {
  return options.n_threads > 0 || !started_on_several_ranks() ? options.n_threads
                                                              : fem::Environment::n_threads();
}

/// The journal of a sweep, and the rows of a sweep before that it takes over.
struct KnownRows {
  SweepJournal journal;
  std::vector<std::optional<SweepRow>> rows;

  /// Called once every point was read.
  KnownRows(const SweepCommandOptions& options, const Sweep& sweep, const std::filesystem::path& directory)
      : journal(directory / "journal", journal_key("sweep", sweep.options(options, options.n_threads))),
        rows(options.fresh ? std::vector<std::optional<SweepRow>>(sweep.plan.points.size())
                           : journal.known(sweep.plan)) {}
};

/// What every rank but the first does.
void sweep_beside_first_rank(const SweepCommandOptions& options) {
  work_on_bodies_alone();
  const Sweep sweep(options);
  const int n_threads = own_threads(options), rank = fem::this_rank(MPI_COMM_WORLD);
  SweepRun run(sweep.options(options, n_threads), sweep.plan.points);
  run.keep_points(points_of_ranks(run)[std::size_t(rank)]);
  const fem::Environment environment(n_threads);
  fem::wait_for_all(MPI_COMM_WORLD);  // until the first one has begun the journal
  RowsToFirstRank to_first(sweep.plan);
  StageClock silent;
  run.run(silent, KnownRows(options, sweep, sweep.directory).rows,
          [&](const auto& points, const auto& rows) { to_first.send(points, rows); });
  to_first.end(run.n_improved_meshes());
}

/// The rows of all points, in the journal too; on rank 0.
/// @param directory  the sweep's, as it was opened
/// @param environment  begun where there are bodies
std::vector<SweepRow> run_points(const SweepCommandOptions& options, const Sweep& sweep,
                                 const std::filesystem::path& directory, StageClock& clock,
                                 std::optional<fem::Environment>& environment) {
  const auto& plan = sweep.plan;
  const int n_threads = own_threads(options), n_ranks = fem::n_ranks(MPI_COMM_WORLD);
  if (n_ranks > 1) work_on_bodies_alone();
  SweepRun run(sweep.options(options, n_threads), plan.points);
  require_own(directory / "journal", SweepJournal::is_journal, "-o");
  if (!sweep.first.bodies.empty()) environment.emplace(n_threads);

  KnownRows known(options, sweep, directory);
  auto& journal = known.journal;
  const auto n_known = std::size_t(
      std::count_if(known.rows.begin(), known.rows.end(), [](const auto& row) { return row.has_value(); }));
  if (!options.quiet) tell_forecast(run.forecast(), n_known, sweep.accuracy);
  if (run.has_chosen_effects())
    std::cerr
        << "millstress: effects = \"auto\" chooses by the point; a sweep has all of them on at every point\n";
  journal.begin(plan, known.rows);
  const auto keep = [&](const std::vector<std::size_t>& points, const std::vector<SweepRow>& all) {
    for (const auto p : points) journal.append(plan.points[p], all[p]);
    journal.flush();
  };
  RowsOfOtherRanks others(plan, n_ranks);
  std::vector<SweepRow> of_others(plan.points.size());
  if (n_ranks > 1) {
    const auto points = points_of_ranks(run);
    if (!options.quiet) tell_ranks(points);
    run.keep_points(points.front());
    fem::wait_for_all(MPI_COMM_WORLD);  // they begin once the journal has begun
  }
  auto rows = run.run(clock, std::move(known.rows),
                      [&](const std::vector<std::size_t>& points, const std::vector<SweepRow>& all) {
                        keep(points, all);
                        others.take(of_others, keep);
                      });
  others.take_all(of_others, keep);
  for (const auto p : others.points()) rows[p] = std::move(of_others[p]);
  if (const auto n = run.n_improved_meshes() + others.n_improved_meshes(); n > 0)
    std::cerr << fmt::format("millstress: {} more mesh{} searched for points that the first knew less well\n",
                             n, n == 1 ? " was" : "es were");
  if (const auto& faults = run.cache_faults(); !faults.empty())
    std::cerr << "millstress: " << faults.front() << '\n';
  return rows;
}

std::size_t n_of(const std::vector<SweepRow>& rows, bool (*is_one)(const SweepRow&)) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), is_one));
}

bool is_refused(const SweepRow& row) {
  return !row.refused.empty();
}

/// Points that need a look at their rows.
void print_troubles(std::ostream& out, const std::vector<SweepRow>& rows) {
  if (const auto n = n_of(rows, is_refused); n > 0)
    out << fmt::format("\n  {} of {} points were refused: the column says why\n", n, rows.size());
  const auto n = n_of(rows, [](const SweepRow& row) { return row.figure("loads.warnings") > 0; });
  if (n > 0)
    out << fmt::format(
        "\n  {} of {} points have warnings, as many as the column loads.warnings says: `run` or "
        "`loads` with a point's --set tells them\n",
        n, rows.size());
}

/// @throws StageRefused if no point could be computed; ToleranceNotMet if points are known less well than was
///         asked (the default's tolerance, for which nobody asked, is a warning)
void require_known(const Sweep& sweep, const std::vector<SweepRow>& rows) {
  if (n_of(rows, is_refused) == rows.size())
    throw StageRefused("no point could be computed: " + rows.front().refused);
  const auto& accuracy = sweep.accuracy;
  const auto n_worse =
      sweep.loads_only || accuracy.tolerance <= 0 ? 0 : n_known_worse(rows, accuracy.tolerance);
  if (n_worse == 0) return;
  const auto text = fmt::format(
      "{} of {} points are known less well than {:g} %: a mesh that is searched for them "
      "does better (run them by themselves, or begin the sweep at one of them)",
      n_worse, rows.size(), 100 * accuracy.tolerance);
  if (!accuracy.by_default) throw ToleranceNotMet(text + "; the results are kept");
  std::cerr << "millstress: " << text << '\n';
}

void carry_out(const SweepCommandOptions& options, std::ostream& out) {
  const Sweep sweep(options);
  const auto& [tree, settings, request, plan, variant, directory, first, accuracy, loads_only, with_fatigue] =
      sweep;
  StageClock clock(progress_on_stderr(options.verbosity()));
  // The environment outlives the charts: its end unloads Open MPI's libraries, and nothing is drawn in a
  // process that these have left.
  std::optional<fem::Environment> environment;
  StagedResults staged(directory, sweep_names(), "-o", variant);
  auto rows = run_points(options, sweep, staged.directory(), clock, environment);
  const auto numbers = follow_zones(plan, rows);
  add_zone_figures(rows, numbers);
  clock.run("write", [&] {
    if (request.zones) write_sweep_zones(staged.folder() / "zones.csv", plan, rows, numbers);
    write_sweep_csv(staged.folder() / "sweep.csv", plan, rows, threads(options.n_threads));
    write_sweep_h5(staged.folder() / "sweep.h5", plan, rows, first.title);
  });
  std::vector<std::string> figures;
  try {
    figures = shown_figures(request.figures, rows);
  } catch (const OptionError&) {  // whose remedy is sweep.csv
    staged.publish();
    throw;
  }
  const auto charts = clock.run("charts", [&] {
    return draw_charts(staged.folder(), first.title, plan, rows, figures, request.design);
  });
  staged.publish();
  for (const auto& key : keys_without_effect(plan, rows))
    std::cerr << "millstress: no figure of this sweep changes with " << key
              << (loads_only && !first.bodies.empty() ? "; stresses may, which --loads leaves out\n" : "\n");
  if (options.json) {
    out << sweep_json(plan, rows);
  } else {
    print_points(out, plan, rows, figures);
    print_extremes(out, options, plan, rows, figures);
    if (request.zones) print_zones(out, rows, numbers);
    print_troubles(out, rows);
    out << "\n  sweep.csv, sweep.h5" << (request.zones ? ", zones.csv" : "");
    for (const auto& file : charts) out << ", " << file;
    out << " in " << directory.string() << '\n';
  }
  require_known(sweep, rows);
}

}  // namespace

void add_sweep_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<SweepCommandOptions>();
  auto* command = add_scene_command(
      app, "sweep", "many operating points over one mesh and one set of unit responses", *options);
  add_repeated_option(
      *command, "--vary", options->vary,
      "\"KEY = A..B UNIT / N [log]\" or \"KEY = V, V, V\"; may be repeated (default: the scene's)");
  command->add_option("--design", options->design,
                      "grid, one-at-a-time or latin-hypercube (default: the scene's, or grid)");
  command->add_option("--points", options->n_points, "of a Latin hypercube")->check(CLI::Range(2, 1'000'000));
  command->add_option("--seed", options->seed, "of a Latin hypercube")->check(CLI::Range(0L, 1'000'000'000L));
  command->add_flag("--loads", options->loads_only, "the load stage alone, microseconds a point");
  command->add_flag("--zones", options->zones,
                    "the stress zones of every point, followed from point to point");
  add_repeated_option(*command, "--figure", options->figures,
                      "to print and draw, a column of sweep.csv; may be repeated (default: the scene's, or "
                      "governing stresses)");
  command->add_option("-o,--output", options->output, "result directory (default: results/<scene>_sweep)");
  add_force_option(*command, *options);
  command->add_flag("--fresh", options->fresh, "reuse nothing of an earlier sweep");
  command->add_flag("--json", options->json, "print the rows as JSON instead of the table");
  add_run_options(*command, *options, chosen);
  command->callback([options, choose = to_choose(chosen, options, carry_out), &chosen] {
    choose();
    chosen.on_other_ranks = [options] { sweep_beside_first_rank(*options); };
  });
}

}  // namespace pipelines
