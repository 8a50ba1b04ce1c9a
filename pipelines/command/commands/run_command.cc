#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <future>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "fem/mesh/ranks/ranks.h"
#include "fem/models/solid/model.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/disk/staging.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/typography.h"
#include "pipelines/command/commands/run_picture.h"
#include "pipelines/command/commands/run_results.h"
#include "pipelines/command/options/option_value.h"
#include "pipelines/command/options/result_place.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/loads/channels/load_files.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/respond/responses/response_files.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/scene/whole/requested_method.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/loop/duty_loads.h"
#include "pipelines/search/loop/duty_run.h"
#include "pipelines/search/loop/scene_run.h"
#include "pipelines/study/accuracy/cost_forecast.h"
#include "pipelines/write/files/envelope_files.h"
#include "pipelines/write/files/results.h"
#include "pipelines/write/files/run_record.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/pictures/load_charts.h"
#include "pipelines/write/report/html_report.h"
#include "pipelines/write/report/summary.h"

namespace pipelines {
namespace {

struct RunCommandOptions : WantedRun {
  std::filesystem::path output;  ///< directory; empty: the default
  bool fresh = false;
  bool json = false;
  bool strict = false;          ///< a verdict of NOT OK is a failure
  bool with_responses = false;  ///< unit responses are needed beside the results
};

/// What is asked for, and where the results go.
struct Request {
  const RunCommandOptions& options;
  std::ostream& out;
  const std::filesystem::path& directory;
  RequestedAccuracy accuracy;
  std::string key;  ///< run_key
  Variant variant;
};

void print(const Request& request, const std::string& summary, const RunRecord& record) {
  const bool is_verbose = request.options.verbosity() == Verbosity::verbose;
  if (request.options.json) {
    request.out << summary;
  } else {
    const auto& table = is_verbose ? record.full_table : record.table;
    request.out << (stdout_shows_utf8() ? typographic(table) : table) << "  results in "
                << request.directory.string() << '\n';
  }
}

/// @param summary  text of summary.json
void fail_if_strict(const Request& request, const std::string& summary) {
  if (!request.options.strict) return;
  const auto verdict = summary::Json::parse(summary).at("verdict");
  if (verdict.at("judgement") == to_string(Judgement::not_ok))
    throw VerdictNotOk(verdict.at("headline").get<std::string>() + "; the results are kept");
}

/// The torsion of a train without the warnings that its loads have told.
TorsionReport with_new_warnings(TorsionReport torsion, const std::vector<std::string>& told) {
  auto& warnings = torsion.forced.warnings;
  const auto is_told = [&](const std::string& warning) {
    return contains(told, warning) || contains(told, in_start_up(warning));
  };
  warnings.erase(std::remove_if(warnings.begin(), warnings.end(), is_told), warnings.end());
  return torsion;
}

std::string table_of(const RunReport& content, const std::optional<TorsionReport>& torsion,
                     void (*print_tables)(std::ostream&, const RunReport&)) {
  std::ostringstream table;
  print_tables(table, content);
  if (torsion) print_torsion(table, content.scene, with_new_warnings(*torsion, content.loads.warnings));
  return table.str();
}

/// @param staged  null on ranks beside the first one, which make summary and table with it
/// @param folder  where the other results are; not the staged one where the scene keeps the report alone
/// @param living  of the page
/// @param record  but for its table; without a key: this run is not to be taken for a later one
void finish_run(const Request& request, StagedResults* staged, const std::filesystem::path& folder,
                const RunReport& content, const std::optional<TorsionReport>& torsion, RunRecord record,
                const LivingPage& living) {
  const auto summary = summary_json(content);
  record.table = table_of(content, torsion, print_report);
  record.full_table = table_of(content, torsion, print_full_report);
  if (staged == nullptr) return;
  write_text_file(folder / "summary.json", summary);
  write_html_report(folder, request.directory / "accuracy", living);
  record.is_report_alone = folder != staged->folder();
  if (record.is_report_alone)
    for (const char* kept : {"summary.json", "report.html"})
      write_text_file(staged->folder() / kept, whole_file(folder / kept).value());
  if (!are_as_noted(noted_inputs())) record.key.clear();
  write_run_record(staged->folder(), record);
  staged->publish();
  print(request, summary, record);
  fail_if_strict(request, summary);
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

/// Torsion of a drive train, written into the folder torsion; nothing for other machines.
std::optional<TorsionReport> torsion_of(const Scene& scene, const Machine& machine,
                                        const std::filesystem::path& directory, StageClock& clock) {
  if (!kind_of(machine).is_torsional()) return std::nullopt;
  auto torsion = clock.run("torsion", [&] { return report_torsion(scene, machine); });
  if (is_first_rank())
    clock.run("write", [&] { write_torsion_files(directory / "torsion", scene, torsion); });
  return torsion;
}

/// Lives of bearings over the operating blocks of a scene without bodies; none: it has no blocks.
/// @param loads  loads of the scene's own running; takes the blocks' warnings
std::optional<DutyResult> duty_of_loads(const Scene& given, const Scene& scene, kinetics::LoadHistory& loads,
                                        int n_threads, StageClock& clock) {
  if (scene.duty.empty()) return std::nullopt;
  SceneRun run;
  run.loaded.scene = scene;
  run.loaded.loads = loads;
  auto duty = run_duty(given, run, n_threads, clock);
  for (const auto& sentence : duty.warnings) warn(loads, sentence);
  return duty;
}

/// Runs the load stage alone, on one rank: that is enough.
void run_load_stage(const Request& request, const Scene& given, StageClock& clock) {
  if (!is_first_rank()) return;
  work_on_bodies_alone();
  const Scene scene = with_effects_chosen(given, {}, negligible_share(request.accuracy.tolerance));
  auto loads = clock.run("loads", [&] { return load_stage(scene, scene.machine); });
  const auto lives = bearing_lives(scene.bearings, loads, {});
  warn_beyond_ratings(scene.bearings, lives, loads);
  const auto duty = duty_of_loads(given, scene, loads, request.options.n_threads, clock);
  StagedResults staged(request.directory, run_names({}), "-o", request.variant);
  clock.run("write", [&] { write_loads_h5(staged.folder() / "loads.h5", loads); });
  const auto torsion = torsion_of(scene, scene.machine, staged.folder(), clock);
  Loaded loaded;
  loaded.scene = scene;
  loaded.loads = loads;
  const auto living = clock.run("page", [&] { return living_page(loaded, {}, 1); });
  finish_run(
      request, &staged, staged.folder(),
      {scene, loads, {}, {}, clock.costs(), lives, duty ? &*duty : nullptr, torsion ? &*torsion : nullptr},
      torsion, {request.key, {}, {}}, living);
}

/// The default's minute was up before its tolerance was met: told loudly, but no failure, since nobody asked.
/// @return the warnings
std::vector<std::string> warn_of_default(SceneRun& run) {
  std::vector<std::string> warnings;
  for (const auto& analysis : run.analyses) {
    if (analysis.search.met) continue;
    const auto stress = governing_stress(analysis);
    const double percent = 100 * stress.errors.total_Pa() / stress.value_Pa;
    const auto text = fmt::format(
        "{}: {:.3g} MPa is known to {} % only, all its errors together, since {}; the default is 5 % "
        "within 60 s. Give --time-limit or --tolerance for another",
        analysis.scene.name, stress.value_Pa / 1e6,
        percent < 99.5 ? fmt::format("{:.2g}", percent) : fixed(percent, 0), analysis.search.ended);
    warn(run.loaded.loads, text);
    warnings.push_back("millstress: " + text);
  }
  return warnings;
}

/// Whether the same run asked for again shall find these results. What was asked for and missed is tried
/// again; the default is not: its minute ends a search wherever the machine's load has it end.
bool is_kept(const SceneRun& run, const RequestedAccuracy& accuracy) {
  return !run.tells_of_damage() && (accuracy.by_default || (run.met() && !run.time_was_up()));
}

/// Damaged files of an earlier run, each once: the last solve of every body has met those that matter.
void warn_of_damage(SceneRun& run) {
  for (const auto& analysis : run.analyses)
    for (const auto& text : analysis.warnings) warn(run.loaded.loads, text);
}

/// A picture takes seconds, and results are not there before all are drawn.
bool is_too_late_to_draw(const RequestedAccuracy& accuracy, std::chrono::steady_clock::time_point start) {
  constexpr double grace = 1.1;
  if (accuracy.by_default || accuracy.time_limit_s <= 0) return false;
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start;
  return so_far.count() > grace * accuracy.time_limit_s;
}

/// The unit responses of a body beside its results; a beam has none. On all ranks.
void write_responses(const std::filesystem::path& place, const SceneRun& run, const Judged& analysis) {
  const auto key = run.kept.keys.find(analysis.scene.name);
  if (key != run.kept.keys.end() && (is_first_rank() || analysis.responses.shared))
    write_unit_responses(place / responses_file_name, key->second, analysis.responses);
}

/// Harmonics around the axis are not taken by later runs, but by those who read stress over the cycle.
void keep_harmonics(SceneRun& run, StageClock& clock) {
  for (const auto& analysis : run.analyses)
    if (analysis.method == Method::axisymmetric)
      run.kept.keep(analysis, key_of_harmonics(analysis.responses), clock);
}

/// The run's unit responses, by the hashes of their keys.
std::map<std::string, std::string> hashes_of(const KeptResponses& kept) {
  std::map<std::string, std::string> hashes;
  for (const auto& [body, key] : kept.keys) hashes[body] = text_hash(key);
  return hashes;
}

/// The files of all bodies, and the loads'. While one body is drawn, another thread writes what comes next.
/// @param start  start of the run, for its limit of time
/// @return why pictures are missing
std::vector<std::string> write_and_draw(const Request& request, const Scene& scene, const SceneRun& run,
                                        const DutyResult* duty, const std::filesystem::path& folder,
                                        std::chrono::steady_clock::time_point start, StageClock& clock) {
  const int n_threads = threads(request.options.n_threads), n_ranks = n_ranks_of_a_body();
  const auto& loads = run.loaded.loads;
  const auto place = [&](std::size_t i) { return folder / run.analyses[i].scene.name; };
  const auto write = [&](std::size_t i) {
    wait_for_ranks();
    if (i < run.analyses.size()) {
      write_body_results(place(i), run.loaded.scene, loads, run.analyses[i], n_ranks, n_threads);
      if (scene.keep == Keep::all) write_responses(place(i), run, run.analyses[i]);
    } else if (is_first_rank()) {
      write_bodies_together(folder, body_names(scene), n_ranks);
      write_loads_h5(folder / "loads.h5", loads, run.loaded.channels());
      if (scene.keep == Keep::all)
        write_loads_csv(folder / "loads.csv", loads, run.loaded.channels(), n_threads);
    }
  };
  const auto draw = [&](std::size_t i) {
    const auto& speeds = run.analyses[i].critical_speeds;
    if (speeds) write_whirl_chart(place(i), run.loaded.scene.title, *speeds);
    return draw_envelope(place(i), run, run.analyses[i], duty);
  };
  const bool beside = scene.pictures && n_threads > 1 && n_ranks == 1;  // ranks stay in step
  const auto policy = beside ? std::launch::async : std::launch::deferred;
  std::vector<std::string> faults;
  clock.run("write", [&] { write(0); });
  for (std::size_t i = 0; i < run.analyses.size(); ++i) {
    auto next = std::async(policy, write, i + 1);
    const bool draws = scene.pictures && is_first_rank();
    const auto fault =
        draws && is_too_late_to_draw(request.accuracy, start)
            ? run.analyses[i].scene.name +
                  ": no picture: the time was up; envelope.vtu opens in ParaView, a longer time limit draws "
                  "it"
        : draws ? clock.run("pictures", [&] { return draw(i); })
                : std::string();
    clock.run("write", [&] { next.get(); });
    if (fault.empty()) continue;
    std::cerr << fault << '\n';
    faults.push_back(fault);
  }
  return faults;
}

void run_bodies(const Request& request, const Scene& scene, StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  const auto& options = request.options;
  require_blocks(scene);
  const auto accuracy = with_default(request.accuracy);
  const fem::Environment environment(options.n_threads);
  std::optional<StagedResults> staged;  // on the first rank
  fem::on_first_rank(ranks_of_a_body(), [&] {
    staged.emplace(request.directory, run_names(body_names(scene)), "-o", request.variant);
  });
  std::optional<Staging> aside;  // of what is not kept
  if (staged && scene.keep == Keep::report) aside.emplace(OpenDirectory::at(staged->directory()));
  const auto folder = aside ? aside->folder().path() : staged ? staged->folder() : std::filesystem::path();
  SceneRunOptions run_options{options.n_threads, options.fresh, true, accuracy};
  run_options.duty = !scene.duty.empty();
  auto run = run_scene(scene, run_options, clock);
  keep_harmonics(run, clock);
  for (const auto& fault : run.kept.faults) std::cerr << "millstress: " << fault << '\n';
  std::optional<DutyResult> duty;
  if (run_options.duty) {
    duty = run_duty(scene, run, options.n_threads, clock);
    for (const auto& sentence : duty->warnings) warn(run.loaded.loads, sentence);
    for (const auto& sentence : blocks_beyond_the_scene(*duty, run)) warn(run.loaded.loads, sentence);
    for (const auto& sentence : duty_lives_beyond_curves(*duty)) warn(run.loaded.loads, sentence);
  }
  warn_of_damage(run);
  const auto default_warnings = accuracy.by_default ? warn_of_default(run) : std::vector<std::string>();
  const auto& loads = run.loaded.loads;
  RunRecord record{is_kept(run, accuracy) ? request.key : "", hashes_of(run.kept), default_warnings};
  for (const auto& fault : write_and_draw(request, scene, run, duty ? &*duty : nullptr, folder, start, clock))
    record.warnings.push_back(fault);
  if (duty && staged) clock.run("write", [&] { write_duty(folder / "duty.csv", *duty); });
  const Scene reported = with_machine(run.loaded.scene, run.loaded.masses.machine);
  const auto torsion = torsion_of(reported, reported.machine, folder, clock);
  const auto living =
      clock.run("page", [&] { return living_page(run.loaded, run.analyses, threads(options.n_threads)); });
  finish_run(request, staged ? &*staged : nullptr, folder,
             {reported, loads, run.analyses, run.loaded.masses.figures, clock.costs(), run.loaded.bearings,
              duty ? &*duty : nullptr, torsion ? &*torsion : nullptr},
             torsion, std::move(record), living);
  wait_for_ranks();
  if (!run.met() && !accuracy.by_default)
    throw ToleranceNotMet("the tolerance is not met; the results are kept");
}

/// Prints what the last run printed, if this one would be the same and its results are there, whole.
bool is_unchanged(const Request& request, const Scene& scene) {
  if (request.options.fresh) return false;
  const auto earlier =
      earlier_run(request.directory, body_names(scene), request.key, request.options.with_responses);
  if (!earlier) return false;
  for (const auto& warning : earlier->record.warnings) std::cerr << warning << '\n';
  if (request.options.verbosity() != Verbosity::quiet)
    std::cerr << "unchanged since the last run: nothing was computed (--fresh computes anew)\n";
  print(request, earlier->summary, earlier->record);
  fail_if_strict(request, earlier->summary);
  return true;
}

/// The ranks of a machine share its cores.
RunCommandOptions on_this_rank(RunCommandOptions options) {
  if (options.n_threads == 0 && n_ranks_of_a_body() > 1) options.n_threads = fem::Environment::n_threads();
  return options;
}

void run(const RunCommandOptions& as_given, std::ostream& out) {
  const auto options = on_this_rank(as_given);
  Scene scene = read_scene(options.scene, options.settings);
  scene.method = requested_method(options.method, scene);
  const auto variant = variant_of(options);
  const auto directory = results_directory(options.output, default_directory(options), variant);
  const auto accuracy = requested_accuracy_of(options, scene);
  const Request request{
      options,
      out,
      directory,
      accuracy,
      run_key(scene, accuracy, threads(options.n_threads), n_ranks_of_a_body(), noted_inputs()),
      variant};
  if (as_on_first_rank(is_first_rank() && is_unchanged(request, scene))) return;
  require_own_variant(directory, variant);
  double expected_s = 0;
  if (!scene.bodies.empty() && has_progress_bar(options.verbosity())) {
    auto as_asked = scene;
    as_asked.accuracy = accuracy;
    expected_s = expected_seconds(as_asked);
  }
  StageClock clock(progress_on_stderr(options.verbosity(), expected_s));
  (scene.bodies.empty() ? run_load_stage : run_bodies)(request, scene, clock);
}

}  // namespace

void add_run_options(CLI::App& command, WantedRun& options, ChosenCommand& chosen) {
  add_threads_option(command, options.n_threads, chosen);
  command.add_option("--tolerance", options.tolerance,
                     "refine until the stress is known this well, like \"2 %\" (default: the scene's)");
  command.add_option("--time-limit", options.time_limit,
                     "stop each search in time, like \"60 s\" (default: the scene's)");
  command.add_option("--method", options.method,
                     "model of every body: auto, beam, axisymmetric or solid (default: the scene's)");
}

void bring_up_to_date(const WantedRun& wanted, const std::filesystem::path& directory) {
  RunCommandOptions options;
  static_cast<WantedRun&>(options) = wanted;
  options.output = directory;
  options.with_responses = true;
  std::ostringstream table;  // not shown
  run(options, table);
}

void add_run_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<RunCommandOptions>();
  auto* command =
      add_scene_command(app, "run", "everything: loads, mesh, stresses, zones, results", *options);
  add_results_option(*command, options->output);
  add_force_option(*command, *options);
  add_run_options(*command, *options, chosen);
  command->add_flag("--fresh", options->fresh,
                    "reuse nothing of an earlier run, and compute even if nothing has changed");
  command->add_flag("--strict", options->strict, "exit code 5 where the verdict is NOT OK; results are kept");
  command->add_flag("--json", options->json, "print summary.json instead of the table");
  command->callback([options, choose = to_choose(chosen, options, run), &chosen] {
    choose();
    chosen.on_other_ranks = [silent = *options]() mutable {
      silent.quiet = true;
      std::ostringstream not_shown;
      run(silent, not_shown);
    };
  });
}

}  // namespace pipelines
