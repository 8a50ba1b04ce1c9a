#include "pipelines/commands.h"

#include <fmt/core.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "fem/model.h"
#include "pipelines/atomic_file.h"
#include "pipelines/calculix_cards.h"
#include "pipelines/effect_report.h"
#include "pipelines/load_files.h"
#include "pipelines/load_statistics.h"
#include "pipelines/mill_reports.h"
#include "pipelines/picture.h"
#include "pipelines/results.h"
#include "pipelines/scene.h"
#include "pipelines/shaft_analysis.h"
#include "pipelines/summary.h"
#include "pipelines/torsion_report.h"
#include "pipelines/units.h"

namespace pipelines {
namespace {

/// What a trunnion that turns with the drum feels: constant loads of the carrier's frame reverse fully.
void add_turning_trunnions(kinetics::LoadHistory& loads) {
  auto turning = kinetics::turned_with_drum(loads, loads.resultant("trunnions"));
  turning.role = "trunnions_turning";
  turning.description = "the same load in axes that turn with the drum";
  loads.resultants.push_back(std::move(turning));
}

kinetics::LoadHistory load_stage(const Scene& scene) {
  if (scene.run_up)
    return kinetics::compute_run_up(scene.vibratory_mill(), scene.kinetics_effects(), *scene.run_up);
  auto loads = compute_loads(scene.machine, scene.kinetics_effects(), scene.sampling);
  if (scene.drum_axes) add_turning_trunnions(loads);
  return loads;
}

/// What the bearings and the coupling carry with the shaft's own mass, beside the load stage's massless
/// figures.
void add_shaft_quantities(kinetics::LoadHistory& loads, const BodyLoads& body) {
  loads.quantities.push_back({"R_E_shaft", "N", "bearing reaction with the shaft's own mass, magnitude",
                              body.frame_bearing_force_N.matrix().colwise().norm().transpose()});
  loads.quantities.push_back(
      {"T_shaft", "N m", "drive torque with the shaft's own mass, clockwise positive", body.drive_torque_Nm});
}

/// The envelope as a picture; a machine that cannot draw gets a line instead.
void draw(const std::filesystem::path& directory, const std::string& title) {
  PictureOptions options;
  options.scale = 1e-6;
  if (!write_picture(directory / "envelope.vtu", "von Mises stress, maximum [Pa]",
                     title + ": largest von Mises stress over the cycle", "MPa", directory / "envelope.png",
                     options))
    std::cerr << "no picture: this machine offers no EGL (package libegl1); envelope.vtu opens in ParaView\n";
}

void report(std::ostream& out, const CommandOptions& options, const RunReport& content) {
  if (options.json)
    out << summary_json(content);
  else
    print_report(out, content);
}

/// Unknowns and memory of the factor before anything is solved: quadratic hexahedra have eight nodes per
/// cell, and CHOLMOD's factor was measured at 2.7 GB for 203 k and 13 GB for 634 k unknowns.
void print_cost(std::ostream& out, std::size_t n_cells) {
  const double unknowns = 3 * 8.3 * double(n_cells);
  out << fmt::format("  about {:.0f} k unknowns, factor about {:.1f} GB\n", unknowns / 1e3,
                     2.7 * std::pow(unknowns / 203e3, 1.38));
}

}  // namespace

void run_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  const auto directory =
      options.output.empty() ? std::filesystem::path("results") / scene.file.stem() : options.output;
  StageClock clock(progress_on_stderr(options.verbosity));

  auto loads = clock.run("loads", [&] { return load_stage(scene); });
  if (!scene.shaft) {
    const auto lives = bearing_lives(scene.bearings, loads, nullptr);
    std::filesystem::create_directories(directory);
    clock.run("write", [&] { write_load_results(directory, loads, nullptr); });
    const bool is_train = std::holds_alternative<kinetics::DriveTrain>(scene.machine);
    std::optional<TorsionReport> torsion;
    if (is_train) torsion = clock.run("torsion", [&] { return report_torsion(scene); });
    if (torsion) clock.run("write", [&] { write_torsion_files(directory / "torsion", scene, *torsion); });
    const RunReport content{scene, loads, nullptr, clock.costs(), lives};
    write_text_file(directory / "summary.json", summary_json(content));
    report(out, options, content);
    if (options.json) return;
    if (torsion) print_torsion(out, scene, *torsion);
    out << "\n  results in " << directory.string() << '\n';
    return;
  }
  // Only now: a wrong scene and loads alone need no MPI, which takes half a second and may talk.
  char name[] = "millstress", *arguments[] = {name, nullptr}, **argv = arguments;
  int argc = 1;
  const fem::Environment environment(argc, argv, options.n_threads);
  std::filesystem::create_directories(directory / "shaft");
  const auto analysis =
      analyse_shaft(scene, loads, {directory / "shaft", options.n_threads, options.fresh}, clock);
  add_shaft_quantities(loads, analysis.loads);
  const auto lives = bearing_lives(scene.bearings, loads, &analysis.loads.history);
  clock.run("write", [&] {
    write_load_results(directory, loads, &analysis.loads.history);
    write_shaft_results(directory / "shaft", scene, loads, analysis);
  });
  if (scene.pictures) clock.run("pictures", [&] { draw(directory / "shaft", scene.title); });
  const RunReport content{scene, loads, &analysis, clock.costs(), lives};
  write_text_file(directory / "summary.json", summary_json(content));
  report(out, options, content);
  if (!options.json) out << "\n  results in " << directory.string() << '\n';
}

void loads_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  StageClock clock(progress_on_stderr(options.verbosity));
  const auto loads = clock.run("loads", [&] { return load_stage(scene); });
  std::vector<BearingScene> bearings;  // those at a port of the shaft need `run`
  for (const auto& bearing : scene.bearings)
    if (!scene.shaft || force_of(bearing.load, loads, nullptr)) bearings.push_back(bearing);
  const auto lives = bearing_lives(bearings, loads, nullptr);
  if (!options.output.empty()) clock.run("write", [&] { write_loads_h5(options.output, loads); });
  if (!options.csv.empty()) clock.run("write", [&] { write_loads_csv(options.csv, loads); });
  if (!options.statistics.empty())
    clock.run("write",
              [&] { write_statistics(options.statistics, loads, scene.run_up ? 0 : scene.sampling.turns); });
  if (!options.calculix.empty()) clock.run("write", [&] { write_calculix_cards(options.calculix, loads); });
  report(out, options, {scene, loads, nullptr, clock.costs(), lives});
}

void effects_command(const CommandOptions& options, std::ostream& out) {
  double threshold = 0;
  try {
    threshold = to_si(options.threshold, "1");
  } catch (const UnitError& error) {
    throw std::invalid_argument("--threshold " + options.threshold + ": " + error.what());
  }
  const Scene scene = read_scene(options.scene);
  const EffectReport worth = report_effects(scene, threshold);
  if (options.json)
    out << effects_json(scene, worth);
  else
    print_effects(out, scene, worth);
}

void torsion_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  const TorsionReport torsion = report_torsion(scene);
  if (!options.output.empty()) write_torsion_files(options.output, scene, torsion);
  if (options.json)
    out << torsion_json(scene, torsion);
  else
    print_torsion(out, scene, torsion);
}

void springs_command(const CommandOptions& options, std::ostream& out) {
  print_spring_choice(out, read_scene(options.scene), options.json);
}

void extremes_command(const CommandOptions& options, std::ostream& out) {
  print_torus_extremes(out, read_scene(options.scene), options.json);
}

void check_command(const CommandOptions& options, std::ostream& out) {
  const Scene scene = read_scene(options.scene);
  out << scene.file.string() << ": the scene is valid\n\neffects\n";
  for (const auto& effect : effects_of(scene.machine))
    out << fmt::format("  {:<4}{:<24}{} ({})\n", scene.has_effect(effect.name) ? "on" : "off", effect.name,
                       effect.description, effect.source);
  for (const char* own : {"gravity_shaft", "shaft_inertia"})
    if (scene.shaft)
      out << fmt::format("  {:<4}{:<24}of the shaft's own mass, from its mesh\n",
                         scene.has_effect(own) ? "on" : "off", own);
  out << "\ndefaults used\n";
  for (const auto& d : scene.defaults) out << fmt::format("  {} = {}  ({})\n", d.key, d.value, d.reason);
  if (scene.defaults.empty()) out << "  none\n";
  for (const auto& warning : scene.warnings) out << "warning: " << warning << '\n';
  if (!scene.shaft) return;

  // The mesh is a second's work and the only honest answer to what will be solved; it is made aside and
  // thrown away.
  const AtomicFile scratch(std::filesystem::temp_directory_path() /
                           ("millstress_check_" + scene.file.stem().string() + ".msh"));
  const auto mesh = meshes::build_shaft(scene.shaft->geometry, scene.shaft->mesh, scratch.temporary());
  out << fmt::format("\nshaft: {} cells, scaled Jacobian at least {:.2f}, median {:.2f}\n",
                     mesh.quality.n_cells, mesh.quality.min_scaled_jacobian,
                     mesh.quality.median_scaled_jacobian);
  print_cost(out, mesh.quality.n_cells);
  out << "  ports\n";
  for (const auto& port : mesh.ports)
    out << fmt::format(
        "    {:<24}z {:8.2f} .. {:8.2f} mm, diameter {:6.2f} mm, axis at ({:.2f}, {:.2f}) mm\n", port.name,
        port.begin_m * 1e3, port.end_m * 1e3, port.radius_m * 2e3, port.axis_x_m * 1e3, port.axis_y_m * 1e3);
  auto coarse = scene;
  coarse.sampling.turns = 1;
  const auto channels = planned_channels(coarse, load_stage(coarse), mesh);
  out << fmt::format("  {} channels\n", channels.size());
  for (const auto& channel : channels) out << fmt::format("    shaft/{} [{}]\n", channel.name, channel.unit);
}

}  // namespace pipelines
