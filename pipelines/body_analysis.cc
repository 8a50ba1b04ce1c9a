#include "pipelines/body_analysis.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "fem/cell_stress_at_node.h"
#include "fem/model.h"
#include "pipelines/iteration_memory.h"
#include "pipelines/response_files.h"
#include "pipelines/response_key.h"

namespace pipelines {
namespace {

constexpr double closure_limit = 1e-9;

std::vector<fem::SectionPlane> to_fem_planes(const std::vector<meshes::SectionPlane>& planes) {
  std::vector<fem::SectionPlane> result;
  for (const auto& plane : planes)
    result.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m, plane.inner_radius_m});
  return result;
}

/// The seconds of factorising depend on what a run before has left; results do not: where the iteration gives
/// up, the direct solver takes over, and it is the direct solver from the start in the next run.
fem::UnitResponses solve_or_reuse(const fem::Model& model, const fem::Body& body, const BodyLoads& loads,
                                  const std::vector<fem::SectionPlane>& planes, fem::Solver solver,
                                  const RunOptions& options, int n_threads, bool& reused, StageClock& clock) {
  const auto file = options.directory / "unit_responses.h5";
  const auto key = response_key(body, loads.unit_loads, planes, solver, n_threads);
  if (!options.fresh) {
    auto kept = clock.run("solve", [&] { return read_unit_responses(file, key); });
    if (kept) {
      reused = true;
      return std::move(*kept);
    }
  }
  reused = false;
  auto responses = clock.run("solve", [&] {
    fem::SolverChoice choice;
    choice.solver = solver;
    choice.gave_up_before = !options.fresh && iteration_gave_up_before(options.directory, body_key(body));
    return model.unit_responses(
        loads.unit_loads, planes, fem::Recovery::patch,
        [&](double share, const std::string& step) { clock.advance(share, step); }, choice);
  });
  clock.run("write", [&] {
    remember_iteration(options.directory, body_key(body), responses.solver.gave_up);
    write_unit_responses(file, key, responses);
  });
  return responses;
}

void require_closure(const std::string& body, const Closure& closure) {
  if (closure.worst_force() <= closure_limit && closure.worst_moment() <= closure_limit &&
      closure.channel_resultant <= closure_limit)
    return;
  std::ostringstream text;
  text << "the loads on the " << body << " do not close on the mesh: forces to " << closure.worst_force()
       << ", moments to " << closure.worst_moment() << ", channels to " << closure.channel_resultant
       << " of their scale; " << closure_limit
       << " is required. The scene's effects leave a resultant that nothing carries";
  throw std::runtime_error(text.str());
}

/// Von Mises at a node and instant with other unit stresses or time factors than the run's.
double von_mises_with(const std::vector<std::array<double, 6>>& unit, const Eigen::ArrayXd& factors) {
  Stress stress{};
  for (std::size_t k = 0; k < unit.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c) stress[c] += factors[Eigen::Index(k)] * unit[k][c];
  return von_mises_Pa(stress);
}

/// The highest harmonic n > 1 among the channels, and whether channel k belongs to it.
std::vector<bool> highest_harmonic(const std::vector<fem::UnitLoad>& loads) {
  int highest = 0;
  for (const auto& load : loads)
    if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape))
      highest = std::max(highest, pressure->harmonic);
  std::vector<bool> belongs;
  for (const auto& load : loads) {
    const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape);
    belongs.push_back(pressure && pressure->harmonic == highest);
  }
  return belongs;
}

StressErrors estimate_errors(const Peak& peak, const BodyAnalysis& analysis, const fem::Material& material) {
  const auto& history = analysis.loads.history;
  const auto n_instants = history.values.cols();
  const Eigen::ArrayXd factors = history.values.col(peak.instant);
  const std::size_t n_channels = history.channels.size();
  std::vector<std::array<double, 6>> unit(n_channels);
  for (std::size_t k = 0; k < n_channels; ++k)
    std::copy_n(&analysis.responses.stress_Pa[(peak.node * n_channels + k) * 6], 6, unit[k].begin());

  StressErrors errors;
  // The cycle is periodic, so the neighbours of the first and last instant are each other.
  const double before =
      von_mises_with(unit, history.values.col((peak.instant + n_instants - 1) % n_instants));
  const double after = von_mises_with(unit, history.values.col((peak.instant + 1) % n_instants));
  const double curvature = before - 2 * peak.value_Pa + after;
  if (curvature < 0) errors.time_sampling = (before - after) * (before - after) / (-8 * curvature);

  Eigen::ArrayXd without = factors;
  const auto belongs = highest_harmonic(analysis.loads.unit_loads);
  for (std::size_t k = 0; k < n_channels; ++k)
    if (belongs[k]) without[Eigen::Index(k)] = 0;
  errors.pressure_harmonics = std::abs(von_mises_with(unit, without) - peak.value_Pa);
  for (const auto& of_cell : fem::cell_stress_at_node_Pa(analysis.responses, material, peak.node))
    errors.discretisation =
        std::max(errors.discretisation, std::abs(von_mises_with(of_cell, factors) - peak.value_Pa));
  errors.linear_solver = analysis.responses.residual * peak.value_Pa;
  return errors;
}

Peak headline(const BodyAnalysis& analysis) {
  const auto& maximum = analysis.envelope.von_mises;
  Peak peak;
  peak.node = peak_node(maximum.value_Pa, analysis.places);
  std::copy_n(&analysis.responses.nodes.xyz_m[3 * peak.node], 3, peak.position_m.begin());
  peak.value_Pa = maximum.value_Pa[peak.node];
  peak.instant = maximum.instant[peak.node];
  peak.stress_Pa = maximum.stress_Pa[peak.node];
  peak.place = analysis.places.place[peak.node];
  if (const auto feature = analysis.places.feature[peak.node]; feature >= 0)
    peak.feature = analysis.places.feature_names[std::size_t(feature)];
  peak.safety = analysis.scene.yield_strength_Pa / peak.value_Pa;
  const std::size_t n_effects = analysis.loads.history.effects.size();
  const auto shares = analysis.envelope.effect_share.begin() + std::ptrdiff_t(peak.node * n_effects);
  peak.effect_share.assign(shares, shares + std::ptrdiff_t(n_effects));
  peak.errors = estimate_errors(peak, analysis, analysis.scene.material);
  return peak;
}

double zone_level(const ZoneRule& rule, double peak_Pa, double yield_Pa) {
  return rule.share * (rule.reference == ZoneRule::Reference::peak ? peak_Pa : yield_Pa);
}

/// Where deflection is measured from.
std::vector<std::string> references(const BodyScene& body) {
  switch (body.role) {
    case BodyRole::vibratory_shaft:
      return {"main_bearing_1", "main_bearing_2"};
    case BodyRole::drum:
      return {"trunnion_1", "trunnion_2"};
    case BodyRole::stub_axle:
      return {"clamp"};
    case BodyRole::train_shaft:
      return {body.train.bearings[0], body.train.bearings[1]};
    case BodyRole::table_body:
      return body.table.bearings;
    case BodyRole::chamber:
      break;
  }
  return {};
}

}  // namespace

LoadedBody loaded_body(const BodyScene& scene, const MeshedBody& meshed) {
  LoadedBody loaded{scene.name, meshed.mesh.ports, meshed.regions, scene.pressures};
  for (const auto& port : meshed.mesh.ports) {
    PressureModel usual;
    usual.highest_harmonic = scene.pressure_harmonics;
    loaded.pressures.try_emplace(port.name, usual);
  }
  return loaded;
}

BodyLoads distribute_body(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                          const LoadedBody& loaded, const MassAgreement& masses) {
  const auto& attached = masses.attached.at(body.name);
  switch (body.role) {
    case BodyRole::vibratory_shaft: {
      VibratoryShaftOptions options;
      options.gravity_m_s2 = scene.vibratory_mill().gravity_m_s2;
      options.own_weight = scene.has_effect("gravity_shaft");
      options.own_inertia = scene.has_effect("shaft_inertia");
      options.debalance_shares = {body.debalance_shares.at(0), body.debalance_shares.at(1)};
      return distribute_vibratory_shaft(history, loaded, options);
    }
    case BodyRole::chamber:
      return distribute_chamber(history, std::get<kinetics::VibratoryMill>(masses.machine), loaded,
                                {scene.effects, attached.structure, attached.exciter, body.pitch_guide});
    case BodyRole::drum:
      return distribute_drum(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                             {scene.effects, attached.structure});
    case BodyRole::stub_axle: {
      auto options = body.stub_axle;
      options.effects = scene.effects;
      return distribute_stub_axle(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                                  options);
    }
    case BodyRole::train_shaft: {
      const auto& train = std::get<kinetics::DriveTrain>(masses.machine);
      auto options = body.train;
      options.effects = scene.effects;
      options.attached = attached.structure;
      options.forces.erase(std::remove_if(options.forces.begin(), options.forces.end(),
                                          [&](const auto& force) { return !scene.has_effect(force.effect); }),
                           options.forces.end());
      return distribute_train_shaft(history, kinetics::mean_speed_rad_s(train, options.inertia), loaded,
                                    options);
    }
    case BodyRole::table_body:
      return distribute_table(std::get<kinetics::LoadTable>(scene.machine), scene.effects, scene.sampling,
                              loaded, body.table);
  }
  throw std::logic_error("unknown role of a body");
}

void require_closed_loads(const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  if (loads.unit_loads.empty())
    throw std::invalid_argument("no effect of the scene loads the " + loads.history.body +
                                "; name one that does, or remove [" + loads.history.body + "]");
  std::vector<std::array<double, 6>> wanted;
  for (const auto& load : loads.unit_loads) wanted.push_back(wanted_resultant(load, regions));
  require_closure(loads.history.body, check_closure(loads, wanted, regions));
}

BodyAnalysis analyse_body(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                          BodyLoads loads, const RunOptions& options, StageClock& clock) {
  const int n_threads =
      options.n_threads > 0 ? options.n_threads : int(std::max(1u, std::thread::hardware_concurrency()));
  const ShaftShape* shaft = body.shaft();
  BodyAnalysis analysis;
  analysis.scene = body;
  analysis.mesh = meshed.mesh;
  analysis.masses = meshed.masses;
  analysis.geometry_error = meshed.geometry_error;
  const auto planes = to_fem_planes(meshed.mesh.sections);
  analysis.loads = std::move(loads);
  analysis.responses = solve_or_reuse(*meshed.model, meshed.body, analysis.loads, planes, body.solver,
                                      options, n_threads, analysis.responses_reused, clock);
  analysis.closure = check_closure(analysis.loads, analysis.responses.resultants, meshed.regions);
  require_closure(body.name, analysis.closure);

  analysis.envelope =
      clock.run("superpose", [&] { return envelope(analysis.loads.history, analysis.responses, n_threads); });
  clock.run("zones", [&] {
    analysis.places = locate_nodes(analysis.responses.nodes, analysis.mesh.features, analysis.mesh.ports,
                                   analysis.mesh.sharp_edges);
    analysis.peak = headline(analysis);
    analysis.principal_node = peak_node(analysis.envelope.principal.value_Pa, analysis.places);
    analysis.zones = find_zones(analysis.responses.nodes, analysis.envelope.von_mises, analysis.places,
                                zone_level(scene.zones, analysis.peak.value_Pa, body.yield_strength_Pa),
                                body.yield_strength_Pa);
    analysis.hot_spots = hot_spot_stresses(meshed.mesh.hot_spots, analysis.responses, analysis.loads.history);
  });
  if (shaft != nullptr && meshed.mesh.sections.size() > 1)
    analysis.diagrams = clock.run("sections", [&] {
      return section_diagrams(analysis.loads, analysis.responses, analysis.mesh, shaft->geometry,
                              body.material.density_kg_m3, references(body));
    });
  return analysis;
}

}  // namespace pipelines
