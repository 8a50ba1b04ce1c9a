#include "pipelines/commands/commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "fem/ranks/helper_ranks.h"
#include "pipelines/accuracy/cost_forecast.h"
#include "pipelines/analysis/body_analysis.h"
#include "pipelines/analysis/error_text.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/calculix/calculix_cards.h"
#include "pipelines/commands/option_value.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/failure.h"
#include "pipelines/common/fem_environment.h"
#include "pipelines/effects/body_effect_report.h"
#include "pipelines/effects/effect_choice.h"
#include "pipelines/effects/effect_report.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/loads/effect_closure.h"
#include "pipelines/loads/load_files.h"
#include "pipelines/loads/load_statistics.h"
#include "pipelines/pictures/picture.h"
#include "pipelines/report/envelope_files.h"
#include "pipelines/report/html_report.h"
#include "pipelines/report/mill_reports.h"
#include "pipelines/report/results.h"
#include "pipelines/report/summary.h"
#include "pipelines/report/torsion_report.h"
#include "pipelines/scene/body_effects.h"
#include "pipelines/scene/requested_method.h"
#include "pipelines/scene/scene.h"
#include "pipelines/search/scene_run.h"

namespace pipelines {
namespace {

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

void report(std::ostream& out, const CommandOptions& options, const RunReport& content) {
  if (options.json)
    out << summary_json(content);
  else
    print_report(out, content);
}

/// Whether the loads of a scene cannot be told without its bodies' meshes: masses come from there, or effects
/// are to be chosen by what the bodies feel.
bool needs_meshes(const Scene& scene) {
  return !scene.bodies.empty() && (!scene.masses_from_mesh.empty() || scene.effect_choice.open);
}

void finish_run(const CommandOptions& options, std::ostream& out, const std::filesystem::path& directory,
                const RunReport& content) {
  write_text_file(directory / "summary.json", summary_json(content));
  write_html_report(directory);
  report(out, options, content);
}

RequestedAccuracy requested_accuracy_of(const CommandOptions& options, const Scene& scene) {
  return requested_search(options.tolerance, options.time_limit, scene.accuracy);
}

/// The scene with the masses that it leaves to a mesh: a report must not take what stands for them until
/// then.
Scene with_machine(Scene scene, const Machine& machine) {
  scene.machine = machine;
  return scene;
}

/// Masses that only a mesh can tell, for commands that need no more of it; the meshes are thrown away.
Machine machine_with_masses(const Scene& scene, int n_threads) {
  if (scene.masses_from_mesh.empty()) return scene.machine;
  const FemEnvironment environment(n_threads);
  return agree_masses(scene, ScratchMeshes(scene).bodies()).machine;
}

/// Of a scene without bodies effects = "auto" looks at the loads alone.
Scene chosen_by_loads(Scene scene, double tolerance) {
  return with_effects_chosen(std::move(scene), {}, negligible_share(tolerance));
}

/// Of a drive train, written into the folder torsion; nothing for other machines.
std::optional<TorsionReport> torsion_of(const Scene& scene, const Machine& machine,
                                        const std::filesystem::path& directory, StageClock& clock) {
  if (!std::holds_alternative<kinetics::DriveTrain>(machine)) return std::nullopt;
  auto torsion = clock.run("torsion", [&] { return report_torsion(scene, machine); });
  clock.run("write", [&] { write_torsion_files(directory / "torsion", scene, torsion); });
  return torsion;
}

void run_load_stage(const CommandOptions& options, std::ostream& out, const Scene& given,
                    const std::filesystem::path& directory, StageClock& clock) {
  const Scene scene = chosen_by_loads(given, requested_accuracy_of(options, given).tolerance);
  const auto loads = clock.run("loads", [&] { return load_stage(scene, scene.machine); });
  const auto lives = bearing_lives(scene.bearings, loads, {});
  std::filesystem::create_directories(directory);
  clock.run("write", [&] { write_load_results(directory, loads, {}); });
  const auto torsion = torsion_of(scene, scene.machine, directory, clock);
  finish_run(options, out, directory, {scene, loads, {}, {}, clock.costs(), lives});
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
        "--time-limit "
        "or --tolerance for another",
        analysis.scene.name, stress.value_Pa / 1e6, 100 * stress.relative_error(), analysis.search.ended);
    std::cerr << "millstress: " << text << '\n';
    run.loaded.loads.warnings.push_back(text);
  }
}

void run_bodies(const CommandOptions& options, std::ostream& out, const Scene& scene,
                const std::filesystem::path& directory, StageClock& clock) {
  const auto accuracy = with_default(requested_accuracy_of(options, scene));
  const FemEnvironment environment(options.n_threads);
  auto run = run_scene(scene, {directory, options.n_threads, options.fresh, true, accuracy}, clock);
  learn_from(run);
  if (accuracy.by_default) warn_of_default(run);
  const auto& loads = run.loaded.loads;
  const auto channels = run.loaded.channels();
  for (const auto& analysis : run.analyses) {
    const auto place = directory / analysis.scene.name;
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
  clock.run("write", [&] { write_load_results(directory, loads, channels); });
  const Scene reported = with_machine(run.scene, run.loaded.masses.machine);
  const auto torsion = torsion_of(reported, reported.machine, directory, clock);
  finish_run(options, out, directory,
             {reported, loads, run.analyses, run.loaded.masses.figures, clock.costs(), run.loaded.bearings});
  if (!options.json && torsion) print_torsion(out, reported, *torsion);
  if (!options.json) out << "\n  results in " << directory.string() << '\n';
  if (!run.met() && !accuracy.by_default)
    throw ToleranceNotMet("the tolerance is not met; the results are kept");
}

}  // namespace

void run_command(const CommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene);
  scene.method = requested_method(options.method, scene);
  const auto directory =
      options.output.empty() ? std::filesystem::path("results") / scene.file.stem() : options.output;
  StageClock clock(progress_on_stderr(options.verbosity));
  (scene.bodies.empty() ? run_load_stage : run_bodies)(options, out, scene, directory, clock);
}

namespace {

/// The load stage, with the effects that the scene's bodies leave on and the masses that they have. What is
/// meshed for that has to be in equilibrium, too.
/// @param scene  on return with its effects chosen
kinetics::LoadHistory loads_of(Scene& scene, const CommandOptions& options, StageClock& clock) {
  const double limit = negligible_share(scene.accuracy.tolerance);
  if (!needs_meshes(scene)) {
    if (scene.bodies.empty()) scene = with_effects_chosen(std::move(scene), {}, limit);
    return clock.run("loads", [&] { return load_stage(scene, scene.machine); });
  }
  const FemEnvironment environment(options.n_threads);
  const auto meshed = clock.run("mesh", [&] { return ScratchMeshes(scene).bodies(); });
  scene = clock.run("effects", [&] { return with_effects_chosen(std::move(scene), meshed, limit); });
  const auto masses = agree_masses(scene, meshed);
  auto trial = clock.run("loads", [&] { return try_effects(scene, meshed, masses); });
  require_equilibrium(scene, meshed, masses, trial.bodies);
  scene.machine = masses.machine;  // a report must not take what stands for its masses until then
  return std::move(trial.history);
}

}  // namespace

void loads_command(const CommandOptions& options, std::ostream& out) {
  require_extension(
      "--output", options.output, {".h5", ".hdf5", ".hdf"},
      "is written as HDF5; for a table write --csv " + options.output.string() + ", or end the name in .h5");
  require_extension(
      "--csv", options.csv, {".csv", ".txt"},
      "is written as CSV; for HDF5 write -o " + options.csv.string() + ", or end the name in .csv");
  Scene scene = read_scene(options.scene);
  StageClock clock(progress_on_stderr(options.verbosity));
  const auto loads = loads_of(scene, options, clock);
  std::vector<BearingScene> bearings;  // those at a port of a body need `run`
  for (const auto& bearing : scene.bearings)
    if (scene.bodies.empty() || force_of(bearing.load, loads, {})) bearings.push_back(bearing);
  const auto lives = bearing_lives(bearings, loads, {});
  if (!options.output.empty()) clock.run("write", [&] { write_loads_h5(options.output, loads); });
  if (!options.csv.empty()) clock.run("write", [&] { write_loads_csv(options.csv, loads); });
  if (!options.statistics.empty())
    clock.run("write",
              [&] { write_statistics(options.statistics, loads, scene.run_up ? 0 : scene.sampling.turns); });
  if (!options.calculix.empty()) clock.run("write", [&] { write_calculix_cards(options.calculix, loads); });
  const RunReport content{scene, loads, {}, {}, clock.costs(), lives};
  if (options.json) {
    out << with_effects_of_bodies(summary_json(content), scene);
  } else {
    print_report(out, content);
    print_effects_of_bodies(out, scene);
  }
}

void effects_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  const double usual = scene.effect_choice.open ? negligible_share(scene.accuracy.tolerance) : 0.01;
  const double threshold =
      options.threshold.empty() ? usual : option_in_si("--threshold", options.threshold, "1");
  const EffectReport worth = report_effects(scene, threshold);
  if (options.json) {
    out << with_effects_of_bodies(effects_json(scene, worth), scene);
  } else {
    print_effects(out, scene, worth);
    print_effects_of_bodies(out, scene);
  }
  if (!options.json && scene.effect_choice.open && !scene.bodies.empty())
    out << "  effects = \"auto\" is judged by the loads on the bodies in a run; `check` lists what goes\n";
}

void torsion_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  const TorsionReport torsion = report_torsion(scene, machine_with_masses(scene, options.n_threads));
  if (!options.output.empty()) write_torsion_files(options.output, scene, torsion);
  if (options.json)
    out << torsion_json(scene, torsion);
  else
    print_torsion(out, scene, torsion);
  if (!options.json)
    for (const auto& warning : scene.warnings) out << "  warning: " << warning << '\n';
}

void springs_command(const CommandOptions& options, std::ostream& out) {
  print_spring_choice(out, read_scene(options.scene), options.json);
}

void extremes_command(const CommandOptions& options, std::ostream& out) {
  print_torus_extremes(out, read_scene(options.scene), options.json);
}

void report_command(const CommandOptions& options, std::ostream& out) {
  write_html_report(options.output);
  out << (options.output / "report.html").string() << '\n';
}

namespace {

/// The scene over no more turns than take a second; a table's samples need all of theirs.
Scene for_a_look(Scene scene) {
  constexpr int most_instants = 20'000;
  if (!std::holds_alternative<kinetics::LoadTable>(scene.machine))
    scene.sampling.turns =
        std::clamp(most_instants / scene.sampling.instants_per_turn, 1, scene.sampling.turns);
  return scene;
}

void print_load_warnings(std::ostream& out, const kinetics::LoadHistory& loads) {
  for (const auto& warning : loads.warnings) out << "warning: " << warning << '\n';
}

/// Prints on `out` what the scene comes to; throws what a run would throw before it solves.
void check(const CommandOptions& options, std::ostream& out) {
  Scene scene = read_scene(options.scene);
  out << scene.file.string() << ": the scene is valid\n\neffects\n";
  for (const auto& effect : effect_table(scene))
    out << fmt::format("  {:<4}{:<24}{} ({})\n", scene.has_effect(effect.name) ? "on" : "off", effect.name,
                       effect.description, effect.source);
  out << "\ndefaults used\n";
  for (const auto& d : scene.defaults) out << fmt::format("  {} = {}  ({})\n", d.key, d.value, d.reason);
  if (scene.defaults.empty()) out << "  none\n";
  for (const auto& warning : scene.warnings) out << "warning: " << warning << '\n';
  if (scene.bodies.empty()) {
    const double tolerance = scene.accuracy.tolerance;
    scene = chosen_by_loads(std::move(scene), tolerance);
    print_effect_choice(out, scene, {});
    print_load_warnings(out, load_stage(for_a_look(scene), scene.machine));
    if (std::holds_alternative<kinetics::DriveTrain>(scene.machine)) report_torsion(scene, scene.machine);
    return;
  }

  // The mesh is a second's work and the only honest answer to what will be solved; it is made aside and
  // thrown away.
  const FemEnvironment environment(options.n_threads);
  const ScratchMeshes meshes(scene);
  const auto& meshed = meshes.bodies();
  const auto masses = agree_masses(scene, meshed);
  const double limit = negligible_share(scene.accuracy.tolerance);
  scene = with_effects_chosen(std::move(scene), meshed, limit);
  print_effect_choice(out, scene, {});
  StageClock silent;
  const auto loaded = load_bodies(for_a_look(scene), meshed, silent);
  print_load_warnings(out, loaded.loads);
  if (std::holds_alternative<kinetics::DriveTrain>(scene.machine)) report_torsion(scene, masses.machine);
  for (std::size_t i = 0; i < meshed.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto& quality = meshed[i].mesh.quality;
    out << fmt::format(
        "\n{}: {} cells, scaled Jacobian at least {:.2f}, median {:.2f}; aspect at most {:.0f}\n", body.name,
        quality.n_cells, quality.min_scaled_jacobian, quality.median_scaled_jacobian, quality.max_aspect);
    const auto& geometry = meshed[i].geometry_error;
    out << fmt::format("  curved faces off by at most {:.2g} of their radius ({} faces)\n", geometry.relative,
                       geometry.n_faces);
    out << fmt::format("  mass {:.4g} kg\n", meshed[i].masses.mass_kg);
    for (const auto& figure : masses.figures)
      if (figure.body == body.name)
        out << fmt::format("    {:<28}machine {:.5g} {}, mesh and added masses {:.5g}{}\n", figure.name,
                           figure.given, figure.unit, figure.mesh,
                           figure.from_mesh ? " (from the mesh)" : "");
    out << "  ports\n";
    for (const auto& port : meshed[i].mesh.ports)
      out << fmt::format(
          "    {:<24}z {:8.2f} .. {:8.2f} mm, diameter {:6.2f} mm, axis at ({:.2f}, {:.2f}) mm\n", port.name,
          port.begin_m * 1e3, port.end_m * 1e3, port.radius_m * 2e3, port.axis_x_m * 1e3,
          port.axis_y_m * 1e3);
    const auto& channels = loaded.body_loads[i].history.channels;
    print_forecast(
        out, body, meshed[i],
        {channels.size(), std::size_t(scene.sampling.turns) * std::size_t(scene.sampling.instants_per_turn),
         springs_of(scene), &loaded.body_loads[i]});
    print_effect_sizes(out, loaded.body_loads[i], meshed[i].regions);
    out << fmt::format("  {} channels\n", channels.size());
    for (const auto& channel : channels)
      out << fmt::format("    {}/{} [{}]\n", body.name, channel.name, channel.unit);
  }
}

}  // namespace

void check_command(const CommandOptions& options, std::ostream& printed) {
  std::ostringstream out;
  check(options, out);  // nothing is called valid before all of it is
  printed << out.str();
}

}  // namespace pipelines
