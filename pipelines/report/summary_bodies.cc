#include <algorithm>
#include <cmath>

#include "pipelines/analysis/error_text.h"
#include "pipelines/analysis/exclusion_border.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/body_stages/body_vibration.h"
#include "pipelines/body_stages/shaft_torsion.h"
#include "pipelines/common/statistics.h"
#include "pipelines/estimates/energy_errors.h"
#include "pipelines/report/summary_parts.h"
#include "pipelines/report_parts/fatigue_assumptions.h"
#include "pipelines/report_parts/fatigue_report.h"
#include "pipelines/report_parts/moment.h"
#include "pipelines/report_parts/shaft_torsion_report.h"
#include "pipelines/report_parts/zone_text.h"
#include "pipelines/scene_values/effect_groups.h"

namespace pipelines::summary {

Json place_and_moment(const RunReport& report, const std::array<double, 3>& position,
                      const std::string& feature, Place place, std::int32_t instant) {
  const auto moment = moment_of(report.scene, report.loads, instant);
  return object({{"feature", feature},
                 {"place", to_string(place)},
                 {"position_m", position},
                 {"turn", moment.turn},
                 {"drive_angle_rad", moment.angle_rad}});
}

namespace {

/// "total" of all sources, "numerical" of those that a finer run would mend, "model" of the others.
Json budget_json(const ErrorBudget& budget) {
  Json json = object({{"total", number_or_none(budget.total_Pa())},
                      {"numerical", number_or_none(budget.numerical_Pa())},
                      {"model", number_or_none(budget.total_Pa() - budget.numerical_Pa())}});
  for (const auto* entries : {&budget.numerical, &budget.model})
    for (const auto& entry : *entries) {
      json[entry.source] = number_or_none(entry.value_Pa);
      json["methods"][entry.source] = entry.method;
    }
  return json;
}

/// Seconds are no part of it: they change from run to run.
Json search_json(const Search& search) {
  Json json = object({{"quantity", search.quantity},
                      {"tolerance", number(search.tolerance)},
                      {"met", search.met},
                      {"ended", search.ended}});
  for (const auto& step : search.steps)
    json["steps"].push_back(object({{"mesh", step.fineness},
                                    {"instants_per_turn", step.instants_per_turn},
                                    {"pressure_harmonics", step.pressure_harmonics},
                                    {"dofs", step.n_dofs},
                                    {"value_Pa", number(step.value_Pa)},
                                    {"error", budget_json(step.errors)},
                                    {"dominated_by", step.errors.largest_reducible()}}));
  return json;
}

/// What the body is judged by.
Json governing_json(const RunReport& report, const BodyAnalysis& analysis) {
  const auto stress = governing_stress(analysis);
  const bool is_hot_spot = stress.kind == GoverningStress::Kind::hot_spot;
  Json json = figure(stress.value_Pa, "Pa");
  json["kind"] = is_hot_spot ? "hot_spot" : "peak_von_mises";
  json["name"] = stress.name();
  json["text"] = value_with_errors(stress.value_Pa, stress.errors);
  json["safety_against_yield"] = number_or_none(stress.safety);
  json["error"] = budget_json(stress.errors);
  json.update(place_and_moment(report, stress.position_m, stress.place, stress.surface, stress.instant));
  const auto trouble = not_known_well(stress, analysis.search);
  if (!trouble.empty()) json["not_known_well"] = trouble;
  if (const auto rise = rises_towards_edge(analysis); !rise.empty()) json["rises_towards_edge"] = rise;
  return json;
}

Json peak_json(const RunReport& report, const BodyAnalysis& analysis) {
  const Peak& peak = analysis.peak;
  Json json = figure(peak.value_Pa, "Pa");
  json["error"] = budget_json(peak.errors);
  json["safety_against_yield"] = number_or_none(peak.safety);
  json.update(place_and_moment(report, peak.position_m, peak.feature, peak.place, peak.instant));
  json["stress_Pa"] = peak.stress_Pa;
  const auto& effects = analysis.loads.history.effects;
  for (std::size_t i = 0; i < effects.size(); ++i)
    json["effect_share"][effects[i]] = number(peak.effect_share[i]);
  if (any_sums(effect_groups(effects)))
    for (const auto& group : group_shares(effects, peak.effect_share))
      json["effect_group_share"][group.name] = number(group.share);
  return json;
}

Json principal_json(const RunReport& report, const BodyAnalysis& analysis) {
  const std::size_t node = analysis.principal_node;
  const auto& maximum = analysis.envelope.principal;
  std::array<double, 3> position;
  std::copy_n(&analysis.responses.nodes.xyz_m[3 * node], 3, position.begin());
  Json json = figure(maximum.value_Pa[node], "Pa");
  json.update(place_and_moment(report, position, feature_at(analysis.responses.nodes, analysis.places, node),
                               analysis.places.place[node], maximum.instant[node]));
  json["stress_Pa"] = maximum.stress_Pa[node];
  return json;
}

std::array<double, 3> position_of(const fem::Nodes& nodes, std::size_t node) {
  return {nodes.xyz_m[3 * node], nodes.xyz_m[3 * node + 1], nodes.xyz_m[3 * node + 2]};
}

Json torsion_json(const BodyAnalysis& analysis) {
  const auto& diagrams = *analysis.diagrams;
  const auto largest_in_section =
      std::max_element(diagrams.sections.begin(), diagrams.sections.end(), [](const auto& a, const auto& b) {
        return a.torsion_Pa.abs().maxCoeff() < b.torsion_Pa.abs().maxCoeff();
      });
  Json json;
  const auto ring = largest_torsion_ring(diagrams);
  json["max_shear_stress"] = figure(ring ? ring->max_Pa : 0.0, "Pa");
  if (ring) {
    json["max_shear_stress"]["error"] = number_or_none(ring_error_Pa(analysis, *ring));
    json["max_shear_stress"]["feature"] = ring->feature;
    json["max_shear_stress"]["z_m"] = ring->z_m;
  }
  json["max_section_shear_stress"] = figure(largest_in_section->torsion_Pa.abs().maxCoeff(), "Pa");
  json["max_section_shear_stress"]["segment"] = largest_in_section->plane.segment;
  json["max_section_shear_stress"]["z_m"] = largest_in_section->plane.z_m;
  const auto mismatch = plain_torsion_mismatch(diagrams);
  json["plain_sections_against_beam"] = number_or_none(mismatch);
  return json;
}

/// How the quasi-static stress is meant: dynamic_amplification is the factor that resonance is expected to
/// put on the peak.
void add_vibration(const Vibration& vibration, Json& json) {
  json["natural_frequencies"] = Json::array();
  for (const auto& natural : vibration.natural_frequencies) {
    json["natural_frequencies"].push_back(figure(natural.value_Hz, "Hz"));
    json["natural_frequencies"].back()["error"] = number(natural.error_Hz);
  }
  const auto& dynamic = vibration.amplification;
  json["dynamic_amplification"] = figure(1 + vibration.to_peak.share, "1");
  if (!vibration.to_peak.place.empty()) json["dynamic_amplification"]["place"] = vibration.to_peak.place;
  json["dynamic_amplification"]["held"] = vibration.held;
  json["dynamic_amplification"]["limit"] = amplification_limit;
  json["dynamic_amplification"]["highest_harmonic"] =
      object({{"order", dynamic.highest.order},
              {"frequency_Hz", dynamic.highest.frequency_Hz},
              {"share", number_or_none(dynamic.highest.share)},
              {"amplification", number(dynamic.highest.amplification)}});
}

Json energy_error_json(const BodyAnalysis& analysis) {
  const auto errors = energy_errors(analysis.responses.energy_error, analysis.loads.history.values);
  Json json = figure(errors.over_cycle, "1");
  for (std::size_t k = 0; k < errors.channels.size(); ++k)
    json["channels"][analysis.responses.channels[k]] = number(errors.channels[k]);
  return json;
}

}  // namespace

Json body_json(const RunReport& report, const BodyAnalysis& analysis) {
  const auto& quality = analysis.mesh.quality;
  Json json;
  if (analysis.fatigue) json["fatigue_strength"] = strength_text(report.scene, analysis);
  json["governing"] = governing_json(report, analysis);
  json["method"] = to_string(analysis.method);
  json["dofs"] = analysis.responses.n_dofs;
  json["cells"] = quality.n_cells;
  json["min_scaled_jacobian"] = number(quality.min_scaled_jacobian);
  json["median_scaled_jacobian"] = number(quality.median_scaled_jacobian);
  json["max_aspect"] = number(quality.max_aspect);
  json["geometry_error"] = object({{"relative", number(analysis.geometry_error.relative)},
                                   {"faces", analysis.geometry_error.n_faces},
                                   {"position_m", analysis.geometry_error.place_m}});
  json["mass"] = figure(analysis.masses.mass_kg, "kg");
  json["unbalance"] =
      figure(std::hypot(analysis.masses.first_moment_kg_m[0], analysis.masses.first_moment_kg_m[1]), "kg m");
  json["channels"] = analysis.responses.channels;
  json["material"] = analysis.scene.material_name;
  json["yield_strength"] = figure(analysis.scene.yield_strength_Pa, "Pa");
  json["peak_von_mises"] = peak_json(report, analysis);
  if (!analysis.responses.energy_error.norm_sqrtJ.empty()) json["energy_error"] = energy_error_json(analysis);
  json["peak_principal"] = principal_json(report, analysis);
  for (const auto& place : analysis.place_stresses)
    json["places"].push_back(object({{"feature", place.feature},
                                     {"von_mises_Pa", number(place.value_Pa)},
                                     {"error_Pa", number_or_none(error_Pa(analysis, place))},
                                     {"position_m", place.position_m}}));
  json["zone_level"] = figure(analysis.zones.level_Pa, "Pa");
  json["zones"] = zones_json(report, analysis);
  if (!analysis.search.steps.empty()) json["search"] = search_json(analysis.search);
  if (analysis.vibration) add_vibration(*analysis.vibration, json);
  if (analysis.diagrams) {
    json["torsion"] = torsion_json(analysis);
    if (auto elements = element_torsion_json(report, analysis); !elements.is_null())
      json["torsion"]["elements"] = std::move(elements);
    for (const auto& seat : analysis.diagrams->seats)
      json["seats"][seat.port] = object({{"z_m", seat.z_m},
                                         {"max_deflection_m", seat.max_deflection_m},
                                         {"max_slope_rad", seat.max_slope_rad}});
    json["stress_against_statics"] = object({{"force", number_or_none(analysis.diagrams->force_mismatch)},
                                             {"bending", number_or_none(analysis.diagrams->bending_mismatch)},
                                             {"torque", number_or_none(analysis.diagrams->torque_mismatch)}});
  }
  for (const auto& spot : analysis.hot_spots) {
    json["hot_spots"].push_back(object({{"name", spot.name},
                                        {"von_mises_Pa", number(spot.von_mises_Pa)},
                                        {"error_Pa", number_or_none(error_Pa(analysis, spot))},
                                        {"normal_max_Pa", number(spot.max_normal_Pa)},
                                        {"normal_min_Pa", number(spot.min_normal_Pa)},
                                        {"position_m", spot.toe_m}}));
    if (spot.resolved != nullptr) continue;
    for (const auto& part : stress_point(spot).parts)
      json["hot_spots"].back()["extrapolated_from"].push_back(object(
          {{"position_m", position_of(analysis.responses.nodes, part.node)}, {"weight", part.weight}}));
  }
  if (!analysis.hot_spots.empty()) json["hot_spots"][0]["error"] = budget_json(analysis.hot_spot_errors);
  if (analysis.fatigue) json["fatigue"] = fatigue_json(report, analysis);
  if (analysis.start_up) json["start_up"] = start_up_json(analysis);
  if (const double border_Pa = largest_at_border_Pa(analysis); border_Pa > 0)
    json["largest_beside_edges"] = figure(border_Pa, "Pa");
  if (analysis.mesh.smallest_size_m > 0)
    json["smallest_size"] = figure(analysis.mesh.smallest_size_m, "m");
  for (const auto& edge : analysis.mesh.straight_edges)
    json["straight_edges"].push_back(
        object({{"position_m", edge.middle_m}, {"length_m", edge.length_m}, {"off_surface_m", edge.off_m}}));
  for (const auto& edge : analysis.mesh.sharp_edges)
    json["singular"].push_back(object({{"edge", edge.name}, {"excluded_within_m", edge.distance_m}}));
  for (const auto& figure : report.masses)
    if (figure.body == analysis.scene.name)
      json["masses"].push_back(object({{"name", figure.name},
                                       {"unit", figure.unit},
                                       {"machine", figure.given},
                                       {"mesh", figure.mesh},
                                       {"from_mesh", figure.from_mesh},
                                       {"difference", figure.share()}}));
  const auto& solver = analysis.responses.solver;
  json["solver"] = object({{"used", solver.used == fem::Solver::iterative ? "iterative" : "direct"},
                           {"reason", solver.reason},
                           {"iterations", solver.used == fem::Solver::iterative ? solver.n_iterations : 0},
                           {"residual", number(analysis.responses.residual)},
                           {"rounding", number(solver.rounding)},
                           {"support_reaction", number(analysis.responses.support_reaction)},
                           {"factor_gigabytes", number(analysis.responses.factor_gigabytes)},
                           {"gave_up", solver.gave_up},
                           {"bytes", number(solver.used_bytes)},
                           {"predicted_bytes", number(solver.predicted().bytes)}});
  for (const auto& rank : solver.ranks)
    json["solver"]["ranks"].push_back(
        object({{"cells", rank.n_cells}, {"unknowns", rank.n_unknowns}, {"bytes", number(rank.bytes)}}));
  return json;
}

}  // namespace pipelines::summary
