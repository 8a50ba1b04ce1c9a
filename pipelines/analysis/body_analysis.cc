#include "pipelines/analysis/body_analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "fem/model/model.h"
#include "fem/ranks/helper_ranks.h"
#include "pipelines/analysis/load_patch.h"
#include "pipelines/common/errors.h"
#include "pipelines/responses/iteration_memory.h"
#include "pipelines/responses/response_files.h"
#include "pipelines/responses/response_key.h"
#include "pipelines/superposition/finite_stress.h"

namespace pipelines {
namespace {

std::vector<fem::SectionPlane> to_fem_planes(const std::vector<meshes::SectionPlane>& planes) {
  std::vector<fem::SectionPlane> result;
  for (const auto& plane : planes)
    result.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m, plane.inner_radius_m});
  return result;
}

std::string key_of(const fem::Body& body, const BodyLoads& loads,
                   const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads) {
  auto key = response_key(body, loads.unit_loads, planes, solver, n_threads);
  if (const int n = fem::n_ranks(MPI_COMM_WORLD); n > 1) key += "ranks " + std::to_string(n) + '\n';
  return key;
}

std::filesystem::path kept_responses(const RunOptions& options) {
  return options.directory / "unit_responses.h5";
}

/// The seconds of factorising depend on what a run before has left; results do not: where the iteration gives
/// up, the direct solver takes over, and it is the direct solver from the start in the next run.
fem::UnitResponses solve_or_reuse(const fem::Model& model, const fem::Body& body, const BodyLoads& loads,
                                  const std::vector<fem::SectionPlane>& planes, fem::Solver solver,
                                  const RunOptions& options, int n_threads, bool& reused, StageClock& clock) {
  const auto key = key_of(body, loads, planes, solver, n_threads);
  reused = false;
  if (!options.fresh)
    if (auto kept = clock.run("solve", [&] { return read_unit_responses(kept_responses(options), key); })) {
      reused = true;
      return std::move(*kept);
    }
  auto responses = clock.run("solve", [&] {
    fem::SolverChoice choice;
    choice.solver = solver;
    choice.gave_up_before = !options.fresh && iteration_gave_up_before(options.directory, body_key(body));
    return model.unit_responses(
        loads.unit_loads, planes, fem::Recovery::patch,
        [&](double share, const std::string& step) { clock.advance(share, step); }, choice);
  });
  remember_iteration(options.directory, body_key(body), responses.solver.gave_up);
  return responses;
}

/// 6 x instants.
Eigen::ArrayXXd stress_over_cycle(const BodyAnalysis& analysis, std::size_t node) {
  const auto n_channels = analysis.responses.channels.size();
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> unit(
      &analysis.responses.stress_Pa[node * n_channels * 6], 6, Eigen::Index(n_channels));
  return unit * analysis.loads.history.values.matrix();
}

ErrorBudget errors_at(const StressPoint& point, const BodyAnalysis& analysis) {
  return self_estimate(point, analysis.responses, analysis.loads, analysis.scene.material,
                       geometry_share(analysis.geometry_error, analysis.responses.nodes, point),
                       analysis.places.excluded);
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
  peak.errors = errors_at({{{peak.node, 1.0}}, peak.instant}, analysis);
  return peak;
}

/// Of all weld toes, and of the first zones: those that are shown.
void estimate_errors(BodyAnalysis& analysis) {
  auto& zones = analysis.zones.zones;
  for (std::size_t i = 0; i < std::min(n_zones_shown, zones.size()); ++i)
    zones[i].error_Pa = errors_at({{{zones[i].peak_node, 1.0}}, zones[i].instant}, analysis).numerical_Pa();
  for (auto& spot : analysis.hot_spots) {
    const auto errors = errors_at(stress_point(spot), analysis);
    spot.error_Pa = errors.numerical_Pa();
    if (&spot == &analysis.hot_spots.front()) analysis.hot_spot_errors = errors;
  }
}

double zone_level(const ZoneRule& rule, double peak_Pa, double yield_Pa) {
  return rule.share * (rule.reference == ZoneRule::Reference::peak ? peak_Pa : yield_Pa);
}

int threads(int wanted) {
  return wanted > 0 ? wanted : int(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace

BodyAnalysis::BodyAnalysis() = default;
BodyAnalysis::BodyAnalysis(const BodyAnalysis&) = default;
BodyAnalysis::BodyAnalysis(BodyAnalysis&&) noexcept = default;
BodyAnalysis& BodyAnalysis::operator=(const BodyAnalysis&) = default;
BodyAnalysis& BodyAnalysis::operator=(BodyAnalysis&&) noexcept = default;
BodyAnalysis::~BodyAnalysis() = default;

BodyAnalysis analyse_body(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                          BodyLoads loads, const RunOptions& options, StageClock& clock) {
  bool reused = false;
  const auto start = std::chrono::steady_clock::now();
  auto responses = solve_or_reuse(*meshed.model, meshed.body, loads, to_fem_planes(meshed.mesh.sections),
                                  body.solver, options, threads(options.n_threads), reused, clock);
  const std::chrono::duration<double> solve = std::chrono::steady_clock::now() - start;
  auto analysis =
      superpose_body(scene, body, meshed, std::move(loads), std::move(responses), options.n_threads, clock);
  analysis.responses_reused = reused;
  analysis.solve_s = reused ? 0 : solve.count();
  return analysis;
}

BodyAnalysis superpose_body(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                            BodyLoads loads, fem::UnitResponses responses, int n_threads, StageClock& clock,
                            std::optional<Envelope> known) {
  const ShaftShape* shaft = body.shaft();
  BodyAnalysis analysis;
  analysis.scene = body;
  analysis.mesh = meshed.mesh;
  analysis.masses = meshed.masses;
  analysis.geometry_error = meshed.geometry_error;
  analysis.loads = std::move(loads);
  analysis.responses = std::move(responses);
  require_finite(analysis.responses);
  analysis.closure = check_closure(analysis.loads, analysis.responses.resultants, meshed.regions);
  require_closure(body.name, analysis.closure);

  const auto start = std::chrono::steady_clock::now();
  analysis.envelope = clock.run("superpose", [&] {
    return known ? std::move(*known)
                 : envelope(analysis.loads.history, analysis.responses, threads(n_threads));
  });
  require_finite(body.name, analysis.envelope);
  analysis.superpose_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  clock.run("zones", [&] {
    analysis.places = locate_nodes(analysis.responses.nodes, analysis.mesh.features, analysis.mesh.ports,
                                   analysis.mesh.sharp_edges);
    analysis.peak = headline(analysis);
    analysis.principal_node = peak_node(analysis.envelope.principal.value_Pa, analysis.places);
    analysis.zones = find_zones(analysis.responses.nodes, analysis.envelope.von_mises, analysis.places,
                                zone_level(scene.zones, analysis.peak.value_Pa, body.yield_strength_Pa),
                                body.yield_strength_Pa);
    analysis.hot_spots = hot_spot_stresses(meshed.mesh.hot_spots, analysis.responses, analysis.loads.history);
    estimate_errors(analysis);
  });
  clock.run("superpose", [&] { add_load_patch_error(analysis); });
  if (shaft != nullptr && meshed.mesh.sections.size() > 1)
    analysis.diagrams = clock.run("sections", [&] {
      return section_diagrams(analysis.loads, analysis.responses, analysis.mesh, shaft->geometry,
                              body.material.density_kg_m3, supporting_ports(body));
    });
  return analysis;
}

void keep_responses(const BodyScene& body, const MeshedBody& meshed, const BodyAnalysis& analysis,
                    const RunOptions& options, StageClock& clock) {
  if (analysis.responses_reused) return;
  clock.run("write", [&] {
    const auto key = key_of(meshed.body, analysis.loads, to_fem_planes(meshed.mesh.sections), body.solver,
                            threads(options.n_threads));
    write_unit_responses(kept_responses(options), key, analysis.responses);
  });
}

void add_vibration(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                   BodyAnalysis& analysis, StageClock& clock) {
  if (analysis.scene.natural_frequencies <= 0) return;
  analysis.vibration = clock.run("natural frequencies", [&] {
    return vibration(scene, analysis.scene, meshed, history, stress_over_cycle(analysis, analysis.peak.node));
  });
  const double more = analysis.vibration->amplification.factor - 1;
  analysis.peak.errors.set_model(
      {"quasi_static", "dynamic amplification of the harmonics of the peak", more * analysis.peak.value_Pa});
}

}  // namespace pipelines
