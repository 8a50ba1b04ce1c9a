#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <ostream>
#include <utility>

#include "fem/models/solid/model.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "pipelines/command/check/check_report.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/judge/analysis/crest_elsewhere.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/search/cheap_models/described_body.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/loop/duty_loads.h"
#include "pipelines/study/accuracy/cost_forecast.h"
#include "pipelines/study/effects/body_effect_report.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"

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

void take_warnings(CheckReport& report, const kinetics::LoadHistory& loads) {
  report.warnings.insert(report.warnings.end(), loads.warnings.begin(), loads.warnings.end());
}

/// How many instants know the crests of every channel, by the spectra of the factors.
std::string instants_text(const Scene& scene, const ChannelHistory& loads) {
  constexpr double share = 1e-3;
  if (!can_be_transformed(loads.values.cols())) return "";
  const auto needed = instants_needed(loads, share);
  const double turns = double(loads.values.cols()) / scene.sampling.instants_per_turn;
  if (needed.channel.empty()) return "";
  return fmt::format(
      "{:.0f} instants a turn tell every channel between them to {:g} %; the scene has {} ({} asks for most, "
      "with orders up to {:.3g} a turn{})",
      std::ceil(needed.n_instants / turns), 100 * share, scene.sampling.instants_per_turn, needed.channel,
      double(needed.highest) / turns,
      needed.is_resolved ? "" : " and beyond: these instants do not resolve it");
}

/// Operating blocks with the loads that each brings; what a run would refuse is refused.
void check_blocks(CheckReport& report, const std::vector<MeshedBody>& meshed) {
  StageClock silent;
  const auto& scene = report.scene;
  for (const auto& block : scene.duty) {
    const auto loads = loads_of_block(with_short_start(block), scene, scene, meshed, silent);
    auto text = fmt::format("{}: {:.4g} % of the time", block.name, 100 * block.share);
    if (block.start)
      text += fmt::format(", {:.4g} starts a day{}", block.start->per_day,
                          loads.starting.empty() ? " from rest to running at once" : " with their run-up");
    report.blocks.push_back(text);
    take_warnings(report, loads.loads);
  }
}

std::string where_is(const meshes::Port& port) {
  if (port.kind == meshes::Port::Kind::face && port.radius_m == 0)
    return fmt::format("face, loaded about ({:.2f}, {:.2f}, {:.2f}) mm", port.axis_x_m * 1e3,
                       port.axis_y_m * 1e3, (port.begin_m + port.end_m) / 2 * 1e3);
  return fmt::format("z {:8.2f} .. {:8.2f} mm, diameter {:6.2f} mm, axis at ({:.2f}, {:.2f}) mm",
                     port.begin_m * 1e3, port.end_m * 1e3, port.radius_m * 2e3, port.axis_x_m * 1e3,
                     port.axis_y_m * 1e3);
}

/// Masses, ports, cost and channels of one body.
CheckedBody checked(const CheckReport& report, const BodyScene& body, const MeshedBody& meshed,
                    const MassAgreement& masses, const BodyLoads& loads) {
  const auto& scene = report.scene;
  CheckedBody result;
  result.name = body.name;
  result.meshed = &meshed;
  for (const auto& figure : masses.figures)
    if (figure.body == body.name) result.masses.push_back(figure);
  for (const auto& port : meshed.mesh.ports) result.ports.push_back({port.name, where_is(port)});
  const auto& channels = loads.history.channels;
  const double n_instants = double(scene.sampling.turns) * scene.sampling.instants_per_turn,
               n_looked_at = double(loads.history.values.cols());
  result.forecast = forecast_ladder(
      body, meshed,
      {channels.size(), std::size_t(n_instants / n_looked_at * double(n_superposed(loads.history))),
       springs_of(scene), &loads});
  result.effects = effect_sizes(loads, meshed.regions);
  result.instants = instants_text(scene, loads.history);
  for (const auto& channel : channels)
    result.channels.push_back(fmt::format("{}/{} [{}]", body.name, channel.name, channel.unit));
  return result;
}

/// Throws what the torsional analysis of the machine would, if there is one.
void try_torsion(const Scene& scene, const Machine& machine) {
  if (kind_of(machine).is_torsional()) report_torsion(scene, machine);
}

void check_load_stage(CheckReport& report) {
  require_blocks(report.scene);
  const double limit = negligible_share(report.scene.accuracy.tolerance);
  report.scene = with_effects_chosen(std::move(report.scene), {}, limit);
  take_warnings(report, load_stage(for_a_look(report.scene), report.scene.machine));
  try_torsion(report.scene, report.scene.machine);
  check_blocks(report, {});
}

/// A body whose ports a mesh alone tells: what its file and its table tell.
CheckedBody outlined(const CheckReport& report, const BodyScene& body, const MeshedBody& described) {
  const auto& scene = report.scene;
  CheckedBody result;
  result.name = body.name;
  result.meshed = &described;
  result.ports_are_known = false;
  std::size_t n_channels = 0;
  for (const auto& port : std::get<meshes::Import>(body.shape).ports) {
    const bool is_face = port.kind == meshes::Port::Kind::face;
    result.ports.push_back({port.name, is_face                                 ? "face"
                                       : port.kind == meshes::Port::Kind::bore ? "bore"
                                                                               : "seat"});
    n_channels += is_face ? 3 : std::size_t(3 + 2 * body.pressure_harmonics);
  }
  const auto n_instants = std::size_t(scene.sampling.turns) * std::size_t(scene.sampling.instants_per_turn);
  result.forecast = forecast_ladder(body, described, {n_channels, n_instants, springs_of(scene)});
  return result;
}

/// A body with ports beside one whose ports a mesh alone tells: its measures.
CheckedBody measured(const CheckReport& report, const BodyScene& body, const MeshedBody& described) {
  CheckedBody result;
  result.name = body.name;
  result.meshed = &described;
  for (const auto& port : described.mesh.ports) result.ports.push_back({port.name, where_is(port)});
  result.forecast = forecast_ladder(body, described, {0, 1, springs_of(report.scene)});
  return result;
}

/// A large mesh keeps silent for long: it is told before.
void tell_what_takes_long(const Scene& scene) {
  constexpr double many_cells = 1e5;
  // Time of the vibratory mill's shaft with 64 cells on each fillet's quarter.
  constexpr double s_per_cell = 1e-4;
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
void check_outlines(CheckReport& report) {
  const auto& scene = report.scene;
  if (scene.masses_from_mesh.empty()) {
    take_warnings(report, load_stage(for_a_look(scene), scene.machine));
    try_torsion(scene, scene.machine);
  }
  for (std::size_t i = 0; i < report.meshed.size(); ++i) {
    const auto& body = scene.bodies[i];
    report.bodies.push_back((has_known_ports(body) ? measured : outlined)(report, body, report.meshed[i]));
  }
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

void check_bodies(CheckReport& report, bool thorough, StageClock& clock) {
  auto& scene = report.scene;
  require_blocks(scene);
  const bool has_cells = thorough || !std::all_of(scene.bodies.begin(), scene.bodies.end(), can_be_refined);
  std::optional<fem::Environment> environment;  // MPI and its threads take longer than all the rest
  if (has_cells) environment.emplace(all_cores);
  report.meshed = bodies_of(scene, thorough, clock);
  const auto& meshed = report.meshed;
  if (!thorough && !std::all_of(scene.bodies.begin(), scene.bodies.end(), has_known_ports)) {
    check_outlines(report);
    return;
  }
  for (std::size_t i = 0; i < meshed.size(); ++i) require_toes(scene.bodies[i], meshed[i].mesh);
  const auto masses = agree_masses(scene, meshed);
  const double limit = negligible_share(scene.accuracy.tolerance);
  scene = with_effects_chosen(std::move(scene), meshed, limit);
  const auto loaded = load_bodies(for_a_look(scene), meshed, clock);
  take_warnings(report, loaded.loads);
  try_torsion(scene, masses.machine);
  for (std::size_t i = 0; i < meshed.size(); ++i)
    report.bodies.push_back(checked(report, scene.bodies[i], meshed[i], masses, loaded.body_loads[i]));
  check_blocks(report, meshed);
}

RunForecast forecast_of(const CheckReport& report) {
  std::vector<std::vector<ModelForecast>> ladders;
  for (const auto& body : report.bodies) ladders.push_back(body.forecast);
  return forecast_run(report.scene, ladders);
}

struct CheckOptions : SceneOptions {
  bool thorough = false;  ///< bodies are meshed
  bool json = false;
};

/// Throws what a run would throw before it meshes, or thoroughly: before it solves.
void check(const CheckOptions& options, std::ostream& out) {
  CheckReport report;
  report.scene = read_scene(options.scene, options.settings);
  const bool all = options.verbosity() == Verbosity::verbose;
  StageClock clock(all ? progress_on_stderr(Verbosity::verbose) : ProgressListener{});
  if (report.scene.bodies.empty()) {
    check_load_stage(report);
  } else {
    check_bodies(report, options.thorough, clock);
    report.run = forecast_of(report);
  }
  if (options.json)
    out << check_json(report);
  else
    print_check(out, report, all);
}

}  // namespace

void add_check_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<CheckOptions>();
  auto* command = add_scene_command(app, "check",
                                    "validate the scene, estimate the cost, list effects and ports (with "
                                    "-v also defaults, masses and channels); mesh and solve nothing",
                                    *options);
  command->add_flag("--thorough", options->thorough,
                    "mesh every body, too: bad cells, ports of CAD files, unknowns to the last one");
  command->add_flag("--json", options->json, "print JSON with everything instead of the table");
  command->callback(to_choose(chosen, options, check));
}

}  // namespace pipelines
