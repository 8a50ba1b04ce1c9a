#include "pipelines/judge/stages/judge_body.h"

#include <algorithm>
#include <limits>

#include "pipelines/judge/analysis/crest_elsewhere.h"
#include "pipelines/judge/analysis/load_edge.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/submodels.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/zone_volume_errors.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/superpose/envelope/finite_stress.h"
#include "pipelines/superpose/envelope/stress_shares.h"
#include "pipelines/superpose/envelope/zone_parts.h"

namespace pipelines {
namespace {

Peak headline(const Superposed& analysis) {
  const auto& maximum = analysis.envelope.von_mises;
  Peak peak;
  peak.node = peak_node(maximum.value_Pa, analysis.places);
  std::copy_n(&analysis.responses.nodes.xyz_m[3 * peak.node], 3, peak.position_m.begin());
  peak.value_Pa = maximum.value_Pa[peak.node];
  peak.instant = maximum.instant[peak.node];
  peak.stress_Pa = maximum.stress_Pa[peak.node];
  peak.place = analysis.places.place[peak.node];
  peak.feature = feature_at(analysis.responses.nodes, analysis.places, peak.node);
  peak.safety = analysis.scene.yield_strength_Pa / peak.value_Pa;
  peak.effect_share =
      shares_of_stress(unit_stresses_at(analysis.responses, peak.node), analysis.loads.history, peak.instant)
          .effects;
  peak.errors = errors_at({{{peak.node, 1.0}}, peak.instant}, analysis);
  return peak;
}

/// States the error of the weld toe with the largest stress, which may govern.
void estimate_error_of_largest_toe(Judged& analysis) {
  if (analysis.hot_spots.empty()) return;
  auto& largest = analysis.hot_spots.front();
  analysis.hot_spot_errors = errors_at(stress_point(largest), analysis);
  largest.error_Pa = analysis.hot_spot_errors.numerical_Pa();
}

/// States the errors of the zones that are shown and of the other weld toes.
/// @param judged  places whose errors count instead
void estimate_errors_shown(Judged& analysis, const std::vector<PlaceStress>& judged) {
  const auto is_judged = [&](const std::string& feature) {
    return std::any_of(judged.begin(), judged.end(), [&](const PlaceStress& place) {
      return place.feature == feature && place.value_Pa > 0;
    });
  };
  auto& zones = analysis.zones.zones;
  for (std::size_t i = 0; i < std::min(n_zones_shown, zones.size()); ++i)
    if (!is_judged(zones[i].feature))
      zones[i].error_Pa = errors_at({{{zones[i].peak_node, 1.0}}, zones[i].instant}, analysis).numerical_Pa();
  for (std::size_t i = 1; i < analysis.hot_spots.size(); ++i)
    if (auto& spot = analysis.hot_spots[i]; !is_judged(spot.name))
      spot.error_Pa = errors_at(stress_point(spot), analysis).numerical_Pa();
}

/// Whether cells of the body were solved that submodels can cut: cheap models have none.
bool has_cells(const fem::UnitResponses& responses) {
  return responses.nodes.n_cells() > 0 && responses.nodes.degree == 2 &&
         !responses.energy_error.norm_sqrtJ.empty();
}

/// The zones of the body's envelope.
Zones zones_of(const Judged& analysis, const ZoneRule& rule) {
  const double yield_Pa = analysis.scene.yield_strength_Pa;
  return find_zones(analysis.responses.nodes, analysis.envelope.von_mises, analysis.places,
                    zone_level_Pa(rule, analysis.peak.value_Pa, yield_Pa), yield_Pa);
}

}  // namespace

double zone_level_Pa(const ZoneRule& rule, double peak_Pa, double yield_Pa) {
  return rule.share * (rule.reference == ZoneRule::Reference::peak ? peak_Pa : yield_Pa);
}

Judged judge_again(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, Judged& before,
                   bool needs_submodels, int n_threads, StageClock& clock) {
  std::optional<Envelope> known;
  if (have_same_values(before.loads.history, loads.history)) known = std::move(before.envelope);
  auto again = responded(body, meshed, std::move(loads), std::move(before.responses));
  again.method = before.method;
  again.responses_reused = before.responses_reused;
  again.warnings = std::move(before.warnings);
  again.solve_s = before.solve_s;
  auto superposed = superpose(std::move(again), threads(n_threads), clock, std::move(known));
  return judge_body(std::move(superposed), meshed, needs_submodels, n_threads, clock, before.hot_spots);
}

Judged judge_body(Superposed superposed, const MeshedBody& meshed, bool needs_submodels, int n_threads,
                  StageClock& clock, const std::vector<HotSpotStress>& known) {
  Judged judged(std::move(superposed));
  clock.run("zones", [&] {
    judged.peak = headline(judged);
    judged.principal_node = peak_node(judged.envelope.principal.value_Pa, judged.places);
    judged.hot_spots = hot_spot_stresses(judged.mesh.hot_spots, judged.responses, judged.loads.history);
  });
  if (needs_submodels && !judged.hot_spots.empty() && has_cells(judged.responses))
    clock.run("submodels", [&] {
      resolve_hot_spots(judged.mesh.hot_spots, judged.responses, meshed.body, judged.loads, judged.hot_spots,
                        known);
    });
  clock.run("zones", [&] { estimate_error_of_largest_toe(judged); });
  clock.run("superpose", [&] {
    add_crest_elsewhere(judged, threads(n_threads));
    add_load_patch_error(judged);
    add_load_edge_error(judged);
  });
  const auto& body = judged.scene;
  if (const ShaftShape* shaft = body.shaft(); shaft != nullptr && judged.mesh.sections.size() > 1)
    judged.diagrams = clock.run("sections", [&] {
      return section_diagrams(judged.loads, judged.responses, judged.mesh, shaft->geometry,
                              body.material.density_kg_m3, reader_of(body).supporting_ports(body));
    });
  return judged;
}

void add_zones(const ZoneRule& rule, Judged& analysis) {
  analysis.zones = divided(zones_of(analysis, rule), analysis.responses.nodes, analysis.envelope.von_mises,
                           analysis.places);
  if (analysis.method == Method::beam)  // its cells span from the surface to the axis
    for (auto& zone : analysis.zones.zones) zone.volume_m3 = std::numeric_limits<double>::quiet_NaN();
  analysis.zone_causes = causes_of(analysis.zones, analysis.responses, analysis.loads.history);
  estimate_errors_shown(analysis, analysis.place_stresses);
  take_zone_errors(analysis);
  estimate_volume_errors(analysis);
}

Judged under_other_loads(Judged analysis, const MeshedBody& meshed, BodyLoads loads, Envelope leading,
                         const ZoneRule* zones) {
  analysis.loads = std::move(loads);
  analysis.closure = check_closure(analysis.loads, analysis.responses.resultants, meshed.regions);
  require_closure(analysis.scene.name, analysis.closure);
  analysis.envelope = std::move(leading);
  require_finite(analysis.scene.name, analysis.envelope);
  analysis.peak = headline(analysis);
  analysis.zones = zones != nullptr ? zones_of(analysis, *zones) : Zones();
  analysis.zone_causes.clear();
  analysis.diagrams.reset();
  const auto before = std::move(analysis.hot_spots);
  analysis.hot_spots = hot_spot_stresses(meshed.mesh.hot_spots, analysis.responses, analysis.loads.history);
  const bool resolved =
      std::any_of(before.begin(), before.end(), [](const auto& spot) { return spot.resolved != nullptr; });
  if (resolved)
    resolve_hot_spots(meshed.mesh.hot_spots, analysis.responses, meshed.body, analysis.loads,
                      analysis.hot_spots, before);
  estimate_error_of_largest_toe(analysis);
  estimate_errors_shown(analysis, {});
  return analysis;
}

}  // namespace pipelines
