#include <algorithm>
#include <cmath>

#include "pipelines/base/common/statistics.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/figures/energy_errors.h"
#include "pipelines/judge/stages/body_vibration.h"
#include "pipelines/write/fields/run_fields.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/parts/fatigue_assumptions.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"
#include "pipelines/write/report/summary_parts.h"

namespace pipelines::summary {

namespace {

Json search_json(const Search& search) {
  Json json = object({{"quantity", search.quantity},
                      {"tolerance", number(search.tolerance)},
                      {"met", search.met},
                      {"ended", search.ended}});
  json["steps"] = summary_rows(search_step_fields(), search.steps);
  return json;
}

/// Torsion beside max_shear_stress, which is a headline.
Json torsion_json(const Judged& analysis) {
  const auto& diagrams = *analysis.diagrams;
  const auto largest_in_section =
      std::max_element(diagrams.sections.begin(), diagrams.sections.end(), [](const auto& a, const auto& b) {
        return a.torsion_Pa.abs().maxCoeff() < b.torsion_Pa.abs().maxCoeff();
      });
  Json json;
  json["max_section_shear_stress"] = figure(largest_in_section->torsion_Pa.abs().maxCoeff(), "Pa");
  json["max_section_shear_stress"]["segment"] = largest_in_section->plane.segment;
  json["max_section_shear_stress"]["z_m"] = largest_in_section->plane.z_m;
  json["plain_sections_against_beam"] = number_or_none(plain_torsion_mismatch(diagrams));
  return json;
}

/// How the quasi-static stress is meant: dynamic_amplification is the factor that resonance is expected to
/// put on the peak.
void add_vibration(const Vibration& vibration, Json& json) {
  json["natural_frequencies"] = summary_rows(natural_frequency_fields(), vibration.natural_frequencies);
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

Json critical_speeds_json(const CriticalSpeeds& speeds) {
  Json json = object({{"operating_speed", figure(speeds.speed_rad_s, "rad/s")}, {"held", speeds.held}});
  json["model"] = model_error_text(speeds);
  json["model_error"] = speeds.model_error ? number(*speeds.model_error) : Json();
  json["modes"] = summary_rows(critical_speed_fields(), speeds.modes);
  json["loads"] = summary_rows(critical_speed_fields(), speeds.loads);
  return json;
}

Json energy_error_json(const Responded& analysis) {
  const auto errors = energy_errors(analysis.responses.energy_error, analysis.loads.history.values);
  Json json = figure(errors.over_cycle, "1");
  for (std::size_t k = 0; k < errors.channels.size(); ++k)
    json["channels"][analysis.responses.channels[k]] = number(errors.channels[k]);
  return json;
}

}  // namespace

Json body_json(const RunReport& report, const Judged& analysis) {
  const auto& quality = analysis.mesh.quality;
  const BodyResult body{report.scene, report.loads, analysis};
  Json json;
  if (analysis.fatigue) json["fatigue_strength"] = strength_text(report.scene, analysis);
  json.update(summary_row(headline_fields(), body));
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
  if (!analysis.responses.energy_error.norm_sqrtJ.empty()) json["energy_error"] = energy_error_json(analysis);
  if (!analysis.place_stresses.empty())
    json["places"] = summary_rows(place_fields(), body, analysis.place_stresses);
  json["zone_level"] = figure(analysis.zones.level_Pa, "Pa");
  json["zones"] = summary_rows(zone_fields(), body, analysis.zones.zones);
  if (!analysis.search.steps.empty()) json["search"] = search_json(analysis.search);
  if (analysis.vibration) add_vibration(*analysis.vibration, json);
  if (analysis.critical_speeds) json["critical_speeds"] = critical_speeds_json(*analysis.critical_speeds);
  if (analysis.diagrams) {
    json["torsion"].update(torsion_json(analysis));
    if (auto elements = element_torsion_json(report, analysis); !elements.is_null())
      json["torsion"]["elements"] = std::move(elements);
    if (auto seats = seats_json(*analysis.diagrams); !seats.is_null()) json["seats"] = std::move(seats);
    json["stress_against_statics"] = object({{"force", number_or_none(analysis.diagrams->force_mismatch)},
                                             {"bending", number_or_none(analysis.diagrams->bending_mismatch)},
                                             {"torque", number_or_none(analysis.diagrams->torque_mismatch)}});
  }
  if (!analysis.hot_spots.empty())
    json["hot_spots"] = summary_rows(hot_spot_fields(), body, analysis.hot_spots);
  if (analysis.fatigue) json["fatigue"] = fatigue_json(report, analysis);
  if (analysis.start_up) json["start_up"] = start_up_json(analysis);
  if (const double border_Pa = largest_at_border_Pa(analysis); border_Pa > 0)
    json["largest_beside_edges"] = figure(border_Pa, "Pa");
  if (analysis.mesh.smallest_size_m > 0) json["smallest_size"] = figure(analysis.mesh.smallest_size_m, "m");
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
                           {"bytes", number(solver.used_bytes)},
                           {"predicted_bytes", number(solver.predicted().bytes)}});
  for (const auto& rank : solver.ranks)
    json["solver"]["ranks"].push_back(
        object({{"cells", rank.n_cells}, {"unknowns", rank.n_unknowns}, {"bytes", number(rank.bytes)}}));
  return json;
}

}  // namespace pipelines::summary
