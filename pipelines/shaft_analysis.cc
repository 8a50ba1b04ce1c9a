#include "pipelines/shaft_analysis.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "fem/mean_cell_stress.h"
#include "fem/model.h"
#include "pipelines/response_files.h"
#include "pipelines/response_key.h"

namespace pipelines {
namespace {

constexpr double closure_limit = 1e-9;

std::vector<fem::SectionPlane> to_fem_planes(const std::vector<meshes::SectionPlane>& planes) {
  std::vector<fem::SectionPlane> result;
  for (const auto& plane : planes)
    result.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m});
  return result;
}

ShaftDistribution distribution_of(const Scene& scene) {
  ShaftDistribution options;
  options.gravity_m_s2 = scene.vibratory_mill().gravity_m_s2;
  options.own_weight = scene.has_effect("gravity_shaft");
  options.own_inertia = scene.has_effect("shaft_inertia");
  options.debalance_shares = {scene.shaft->debalance_shares.at(0), scene.shaft->debalance_shares.at(1)};
  options.pressure_harmonics = scene.shaft->pressure_harmonics;
  return options;
}

/// The seconds of factorising depend on what a run before has left; results do not.
fem::UnitResponses solve_or_reuse(const fem::Model& model, const fem::Body& body, const BodyLoads& loads,
                                  const std::vector<fem::SectionPlane>& planes, const RunOptions& options,
                                  int n_threads, bool& reused, StageClock& clock) {
  const auto file = options.directory / "unit_responses.h5";
  const auto key = response_key(body, loads.unit_loads, planes, n_threads);
  if (!options.fresh) {
    auto kept = clock.run("solve", [&] { return read_unit_responses(file, key); });
    if (kept) {
      reused = true;
      return std::move(*kept);
    }
  }
  reused = false;
  auto responses = clock.run("solve", [&] {
    return model.unit_responses(loads.unit_loads, planes, fem::Recovery::patch,
                                [&](double share, const std::string& step) { clock.advance(share, step); });
  });
  clock.run("write", [&] { write_unit_responses(file, key, responses); });
  return responses;
}

void require_closure(const Closure& closure) {
  if (closure.worst_force() <= closure_limit && closure.worst_moment() <= closure_limit &&
      closure.channel_resultant <= closure_limit)
    return;
  std::ostringstream text;
  text << "the loads on the shaft do not close on the mesh: forces to " << closure.worst_force()
       << ", moments to " << closure.worst_moment() << ", channels to " << closure.channel_resultant
       << " of their scale; " << closure_limit
       << " is required. The scene's effects leave a resultant that no bearing carries";
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

StressErrors estimate_errors(const Peak& peak, const ShaftAnalysis& analysis, const fem::Material& material) {
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
  errors.discretisation =
      std::abs(von_mises_with(fem::mean_cell_stress_Pa(analysis.responses, material, peak.node), factors) -
               peak.value_Pa);
  errors.linear_solver = analysis.responses.residual * peak.value_Pa;
  return errors;
}

Peak headline(const ShaftAnalysis& analysis, const ShaftScene& shaft) {
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
  peak.safety = shaft.yield_strength_Pa / peak.value_Pa;
  const std::size_t n_effects = analysis.loads.history.effects.size();
  const auto shares = analysis.envelope.effect_share.begin() + std::ptrdiff_t(peak.node * n_effects);
  peak.effect_share.assign(shares, shares + std::ptrdiff_t(n_effects));
  peak.errors = estimate_errors(peak, analysis, shaft.material);
  return peak;
}

double zone_level(const ZoneRule& rule, double peak_Pa, double yield_Pa) {
  return rule.share * (rule.reference == ZoneRule::Reference::peak ? peak_Pa : yield_Pa);
}

}  // namespace

fem::Body to_fem_body(const meshes::BodyMesh& mesh, const fem::Material& material) {
  fem::Body body;
  body.mesh = mesh.file;
  body.material = material;
  for (const auto& c : mesh.cylinders)
    body.cylinders.push_back({c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m});
  for (const auto& t : mesh.tori)
    body.tori.push_back({t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m});
  return body;
}

std::vector<Channel> planned_channels(const Scene& scene, const kinetics::LoadHistory& history,
                                      const meshes::BodyMesh& mesh) {
  fem::MassProperties masses;
  for (const auto& segment : scene.shaft->geometry.segments) {
    const double radius = segment.diameter_m / 2, length = segment.end_m - segment.begin_m;
    const double mass = scene.shaft->material.density_kg_m3 * M_PI * radius * radius * length;
    masses.mass_kg += mass;
    masses.first_moment_kg_m[0] += mass * segment.eccentricity_m;
    masses.first_moment_kg_m[2] += mass * (segment.begin_m + segment.end_m) / 2;
  }
  return distribute_shaft(history, mesh.ports, masses, distribution_of(scene)).history.channels;
}

std::vector<SharpCorner> sharp_corners(const meshes::Shaft& shaft) {
  std::vector<SharpCorner> corners;
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i) {
    const auto &left = shaft.segments[i], &right = shaft.segments[i + 1];
    if (shaft.fillets_m[i] > 0 || left.diameter_m == right.diameter_m) continue;
    const double thinner = std::min(left.diameter_m, right.diameter_m);
    corners.push_back({left.name + "/" + right.name, left.end_m, thinner / 2, 0.1 * thinner});
  }
  return corners;
}

ShaftAnalysis analyse_shaft(const Scene& scene, const kinetics::LoadHistory& history,
                            const RunOptions& options, StageClock& clock) {
  if (!scene.shaft) throw std::invalid_argument("analyse_shaft: the scene has no shaft");
  const ShaftScene& shaft = *scene.shaft;
  const int n_threads =
      options.n_threads > 0 ? options.n_threads : int(std::max(1u, std::thread::hardware_concurrency()));

  ShaftAnalysis analysis;
  analysis.mesh = clock.run("mesh", [&] {
    return meshes::build_shaft(shaft.geometry, shaft.mesh, options.directory / "mesh.msh");
  });
  const auto body = to_fem_body(analysis.mesh, shaft.material);
  const auto planes = to_fem_planes(analysis.mesh.sections);
  const auto model = clock.run("model", [&] { return fem::Model(body); });
  analysis.masses = clock.run("model", [&] { return model.mass_properties(); });
  analysis.loads = clock.run("distribute", [&] {
    return distribute_shaft(history, analysis.mesh.ports, analysis.masses, distribution_of(scene));
  });
  analysis.responses = solve_or_reuse(model, body, analysis.loads, planes, options, n_threads,
                                      analysis.responses_reused, clock);
  analysis.closure = check_closure(analysis.loads, analysis.responses.resultants, analysis.masses);
  require_closure(analysis.closure);

  analysis.envelope =
      clock.run("superpose", [&] { return envelope(analysis.loads.history, analysis.responses, n_threads); });
  clock.run("zones", [&] {
    analysis.sharp_corners = sharp_corners(shaft.geometry);
    analysis.places = locate_nodes(analysis.responses.nodes, analysis.mesh.features, analysis.mesh.ports,
                                   analysis.sharp_corners);
    analysis.peak = headline(analysis, shaft);
    analysis.principal_node = peak_node(analysis.envelope.principal.value_Pa, analysis.places);
    analysis.zones = find_zones(analysis.responses.nodes, analysis.envelope.von_mises, analysis.places,
                                zone_level(scene.zones, analysis.peak.value_Pa, shaft.yield_strength_Pa),
                                shaft.yield_strength_Pa);
  });
  analysis.diagrams = clock.run("sections", [&] {
    return section_diagrams(analysis.loads, analysis.responses, analysis.mesh, shaft.geometry,
                            shaft.material.density_kg_m3);
  });
  return analysis;
}

}  // namespace pipelines
