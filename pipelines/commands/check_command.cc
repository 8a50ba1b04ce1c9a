#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>

#include "fem/model/model.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "pipelines/accuracy/cost_forecast.h"
#include "pipelines/analysis/crest_elsewhere.h"
#include "pipelines/analysis/weld_places.h"
#include "pipelines/between_instants/factor_spectrum.h"
#include "pipelines/cheap_models/described_body.h"
#include "pipelines/command_options/scene_options.h"
#include "pipelines/effects/body_effect_report.h"
#include "pipelines/effects/effect_choice.h"
#include "pipelines/estimates/fineness.h"
#include "pipelines/loads/effect_closure.h"
#include "pipelines/loads/load_stage.h"
#include "pipelines/machine_reports/torsion_report.h"
#include "pipelines/machines/load_table_reader.h"
#include "pipelines/report/summary.h"
#include "pipelines/scene/body_effects.h"
#include "pipelines/scene/machine_kind.h"
#include "pipelines/search/duty_loads.h"

namespace pipelines {
namespace {

/// The scene over no more turns than take a second; a table's samples need all of theirs.
Scene for_a_look(Scene scene) {
  constexpr int most_instants = 20'000;
  if (!kind_of(scene.machine).has_samples())
    scene.sampling.turns =
        std::clamp(most_instants / scene.sampling.instants_per_turn, 1, scene.sampling.turns);
  return scene;
}

void print_load_warnings(std::ostream& out, const kinetics::LoadHistory& loads) {
  for (const auto& warning : loads.warnings) out << "warning: " << warning << '\n';
}

/// Effects, defaults and warnings.
void print_scene(std::ostream& out, const Scene& scene) {
  out << scene.file.string() << ": the scene is valid\n\neffects\n";
  for (const auto& effect : effect_table(scene))
    out << fmt::format("  {:<4}{:<24}{} ({})\n", scene.has_effect(effect.name) ? "on" : "off", effect.name,
                       effect.description, effect.source);
  out << "\ndefaults used\n";
  for (const auto& d : scene.defaults) out << fmt::format("  {} = {}  ({})\n", d.key, d.value, d.reason);
  if (scene.defaults.empty()) out << "  none\n";
  const auto samples = samples_read(scene.machine);
  if (!samples.empty()) out << "\nsamples read\n";
  for (const auto& of_effect : samples) out << "  " << of_effect.text() << '\n';
  for (const auto& warning : scene.warnings) out << "warning: " << warning << '\n';
}

/// How many instants know the crests of every channel, by the spectra of the factors.
void print_instants(std::ostream& out, const Scene& scene, const ChannelHistory& loads) {
  constexpr double share = 1e-3;
  if (!can_be_transformed(loads.values.cols())) return;
  const auto needed = instants_needed(loads, share);
  const double turns = double(loads.values.cols()) / scene.sampling.instants_per_turn;
  if (needed.channel.empty()) return;
  out << fmt::format(
      "  {:.0f} instants a turn tell every channel between them to {:g} %; the scene has {} ({} asks for "
      "most, "
      "with orders up to {:.3g} a turn{})\n",
      std::ceil(needed.n_instants / turns), 100 * share, scene.sampling.instants_per_turn, needed.channel,
      double(needed.highest) / turns,
      needed.is_resolved ? "" : " and beyond: these instants do not resolve it");
}

/// Operating blocks with the loads that each brings; what a run would refuse is refused.
void print_blocks(std::ostream& out, const Scene& scene, const std::vector<MeshedBody>& meshed) {
  StageClock silent;
  for (const auto& block : scene.duty) {
    const auto loads = loads_of_block(with_short_start(block), scene, scene, meshed, silent);
    out << fmt::format("\nblock {}: {:.4g} % of the time", block.name, 100 * block.share);
    if (block.start)
      out << fmt::format(", {:.4g} starts a day{}", block.start->per_day,
                         loads.starting.empty() ? " from rest to running at once" : " with their run-up");
    out << '\n';
    print_load_warnings(out, loads.loads);
  }
}

/// The mesh, where it was made.
void print_mesh(std::ostream& out, const BodyScene& body, const MeshedBody& meshed) {
  if (!meshed.model) {
    out << fmt::format("\n{}: not meshed; --thorough does, and looks for bad cells\n", body.name);
    return;
  }
  const auto& quality = meshed.mesh.quality;
  out << fmt::format(
      "\n{}: {} cells, scaled Jacobian at least {:.2f}, median {:.2f}; aspect at most {:.0f}\n", body.name,
      quality.n_cells, quality.min_scaled_jacobian, quality.median_scaled_jacobian, quality.max_aspect);
  const auto& geometry = meshed.geometry_error;
  out << fmt::format("  curved faces off by at most {:.2g} of their radius ({} faces)\n", geometry.relative,
                     geometry.n_faces);
}

/// Mesh, masses, ports, cost and channels of one body.
void print_body(std::ostream& out, const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                const MassAgreement& masses, const BodyLoads& loads) {
  print_mesh(out, body, meshed);
  if (meshed.mesh.smallest_size_m > 0)
    out << fmt::format("  curvature asks for no edges shorter than {:.2g} mm (smallest_size)\n",
                       meshed.mesh.smallest_size_m * 1e3);
  if (const auto& straight = meshed.mesh.straight_edges; !straight.empty()) {
    const auto& most = *std::max_element(straight.begin(), straight.end(),
                                         [](const auto& a, const auto& b) { return a.off_m < b.off_m; });
    out << fmt::format(
        "  {} edges between tangent faces are straighter than their surface, by {:.2g} mm at most, at ({:.2f}, "
        "{:.2f}, {:.2f}) mm\n",
        straight.size(), most.off_m * 1e3, most.middle_m[0] * 1e3, most.middle_m[1] * 1e3,
        most.middle_m[2] * 1e3);
  }
  out << fmt::format("  mass {:.4g} kg\n", meshed.masses.mass_kg);
  for (const auto& figure : masses.figures)
    if (figure.body == body.name)
      out << fmt::format("    {:<28}machine {:.5g} {}, mesh and added masses {:.5g}{}\n", figure.name,
                         figure.given, figure.unit, figure.mesh, figure.from_mesh ? " (from the mesh)" : "");
  out << "  ports\n";
  for (const auto& port : meshed.mesh.ports)
    if (port.kind == meshes::Port::Kind::face && port.radius_m == 0)
      out << fmt::format("    {:<24}face, loaded about ({:.2f}, {:.2f}, {:.2f}) mm\n", port.name,
                         port.axis_x_m * 1e3, port.axis_y_m * 1e3, (port.begin_m + port.end_m) / 2 * 1e3);
    else
      out << fmt::format(
          "    {:<24}z {:8.2f} .. {:8.2f} mm, diameter {:6.2f} mm, axis at ({:.2f}, {:.2f}) mm\n", port.name,
          port.begin_m * 1e3, port.end_m * 1e3, port.radius_m * 2e3, port.axis_x_m * 1e3,
          port.axis_y_m * 1e3);
  const auto& channels = loads.history.channels;
  const double n_instants = double(scene.sampling.turns) * scene.sampling.instants_per_turn,
               n_looked_at = double(loads.history.values.cols());
  print_forecast(
      out, body, meshed,
      {channels.size(), std::size_t(n_instants / n_looked_at * double(n_superposed(loads.history))),
       springs_of(scene), &loads});
  print_effect_sizes(out, loads, meshed.regions);
  print_instants(out, scene, loads.history);
  out << fmt::format("  {} channels\n", channels.size());
  for (const auto& channel : channels)
    out << fmt::format("    {}/{} [{}]\n", body.name, channel.name, channel.unit);
}

/// Throws what the torsional analysis of the machine would, if there is one.
void try_torsion(const Scene& scene, const Machine& machine) {
  if (kind_of(machine).is_torsional()) report_torsion(scene, machine);
}

void check_load_stage(std::ostream& out, Scene scene) {
  require_blocks(scene);
  const double limit = negligible_share(scene.accuracy.tolerance);
  scene = with_effects_chosen(std::move(scene), {}, limit);
  print_effect_choice(out, scene, {});
  print_load_warnings(out, load_stage(for_a_look(scene), scene.machine));
  try_torsion(scene, scene.machine);
  print_blocks(out, scene, {});
}

/// A body whose ports a mesh alone tells: what its file and its table tell.
void print_outline(std::ostream& out, const Scene& scene, const BodyScene& body,
                   const MeshedBody& described) {
  print_mesh(out, body, described);
  out << fmt::format("  mass {:.4g} kg, by the CAD kernel\n", described.masses.mass_kg);
  const auto& ports = std::get<meshes::Import>(body.shape).ports;
  out << "  ports that the scene asks for; --thorough looks for them, and has their channels\n";
  std::size_t n_channels = 0;
  for (const auto& port : ports) {
    const bool is_face = port.kind == meshes::Port::Kind::face;
    out << fmt::format("    {:<24}{}\n", port.name,
                       is_face                                 ? "face"
                       : port.kind == meshes::Port::Kind::bore ? "bore"
                                                               : "seat");
    n_channels += is_face ? 3 : std::size_t(3 + 2 * body.pressure_harmonics);
  }
  const auto n_instants = std::size_t(scene.sampling.turns) * std::size_t(scene.sampling.instants_per_turn);
  print_forecast(out, body, described, {n_channels, n_instants, springs_of(scene)});
}

/// A large mesh keeps silent for long: it is told before.
void tell_what_takes_long(const Scene& scene) {
  constexpr double many_cells = 1e5;
  constexpr double s_per_cell = 1e-4;  // of the vibratory mill's shaft with 64 cells on each fillet's quarter
  for (const auto& body : scene.bodies) {
    const auto* shaft = body.shaft();
    if (shaft == nullptr || !shaft->keyways.empty()) continue;
    const double n_cells = meshes::estimated_cells(shaft->geometry, shaft->mesh);
    if (n_cells > many_cells)
      std::cerr << fmt::format("{}: about {:.2g} cells; to mesh and weigh them takes about {:.2g} s\n",
                               body.name, n_cells, s_per_cell * n_cells);
  }
}

/// Bodies of STEP files have their ports once they are meshed: until then the loads that enter them are not
/// known, nor what of the effects they would leave on.
void check_outlines(std::ostream& out, const Scene& scene, const std::vector<MeshedBody>& described) {
  if (scene.masses_from_mesh.empty()) {
    print_load_warnings(out, load_stage(for_a_look(scene), scene.machine));
    try_torsion(scene, scene.machine);
  }
  for (std::size_t i = 0; i < described.size(); ++i)
    if (has_known_ports(scene.bodies[i]))
      print_mesh(out, scene.bodies[i], described[i]);
    else
      print_outline(out, scene, scene.bodies[i], described[i]);
}

/// Bodies as their measures describe them, or meshed aside and thrown away: then what a mesh alone can tell
/// is checked, too.
std::vector<MeshedBody> bodies_of(const Scene& scene, bool thorough, StageClock& clock) {
  if (thorough) {
    tell_what_takes_long(scene);
    return clock.run("mesh", [&] { return mesh_bodies(scene); });
  }
  return clock.run("describe", [&] {
    std::vector<MeshedBody> bodies;
    for (const auto& body : scene.bodies) bodies.push_back(describe_body(body, springs_of(scene)));
    return bodies;
  });
}

void check_bodies(std::ostream& out, Scene scene, bool thorough, StageClock& clock) {
  require_blocks(scene);
  const bool has_cells = thorough || !std::all_of(scene.bodies.begin(), scene.bodies.end(), can_be_refined);
  std::optional<fem::Environment> environment;  // MPI and its threads take longer than all the rest
  if (has_cells) environment.emplace(all_cores);
  const auto meshed = bodies_of(scene, thorough, clock);
  if (!thorough && !std::all_of(scene.bodies.begin(), scene.bodies.end(), has_known_ports)) {
    check_outlines(out, scene, meshed);
    return;
  }
  for (std::size_t i = 0; i < meshed.size(); ++i) require_toes(scene.bodies[i], meshed[i].mesh);
  const auto masses = agree_masses(scene, meshed);
  const double limit = negligible_share(scene.accuracy.tolerance);
  scene = with_effects_chosen(std::move(scene), meshed, limit);
  print_effect_choice(out, scene, {});
  const auto loaded = load_bodies(for_a_look(scene), meshed, clock);
  print_load_warnings(out, loaded.loads);
  try_torsion(scene, masses.machine);
  for (std::size_t i = 0; i < meshed.size(); ++i)
    print_body(out, scene, scene.bodies[i], meshed[i], masses, loaded.body_loads[i]);
  print_blocks(out, scene, meshed);
}

struct CheckOptions : SceneOptions {
  bool thorough = false;  ///< bodies are meshed
};

/// Throws what a run would throw before it meshes, or thoroughly: before it solves.
void check(const CheckOptions& options, std::ostream& printed) {
  const Scene scene = read_scene(options.scene, options.settings);
  std::ostringstream out;  // nothing is called valid before all of it is
  print_scene(out, scene);
  StageClock clock(options.verbosity() == Verbosity::verbose ? progress_on_stderr(Verbosity::verbose)
                                                             : ProgressListener{});
  if (scene.bodies.empty())
    check_load_stage(out, scene);
  else
    check_bodies(out, scene, options.thorough, clock);
  printed << out.str();
}

}  // namespace

void add_check_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<CheckOptions>();
  auto* command = add_scene_command(app, "check",
                                    "validate the scene, list effects, defaults, ports and channels, "
                                    "estimate the cost; mesh and solve nothing",
                                    *options);
  command->add_flag("--thorough", options->thorough,
                    "mesh every body, too: bad cells, ports of CAD files, unknowns to the last one");
  command->callback(to_choose(chosen, options, check));
}

}  // namespace pipelines
