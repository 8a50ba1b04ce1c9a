#include "pipelines/analysis/place_errors.h"

#include <fmt/core.h>

#include <algorithm>

#include "fem/submodel/submodel.h"
#include "pipelines/analysis/fineness.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/analysis/submodels.h"

namespace pipelines {
namespace {

/// Of the largest stress: below it a place is taken to be as wrong as it can be.
constexpr double worth_a_look = 0.4;

/// Relative error of a fillet's stress with so many cells on its quarter.
double for_want_of_cells(int cells) {
  return cells < 4 ? 0.5 : cells < 6 ? 0.15 : 0.04;
}

double own_error_Pa(const BodyAnalysis& analysis, const StressPoint& point) {
  return self_estimate(point, analysis.responses, analysis.loads, analysis.scene.material, 0,
                       analysis.places.excluded)
      .of("discretisation");
}

/// Of tetrahedra: every place that, as far as single cells tell, may exceed the largest value is looked at by
/// a submodel. Beside a load, which holds the submodel's displacement, single cells have the word.
void ask_submodels(const BodyAnalysis& analysis, double largest_Pa, std::vector<PlaceStress>& places) {
  const auto& responses = analysis.responses;
  if (responses.nodes.n_cells() == 0 || !responses.nodes.shape().is_tetrahedron()) return;
  const auto body = to_fem_body(analysis.mesh, analysis.scene.material);
  for (auto& place : places)
    if (place.value_Pa + place.error_Pa >= largest_Pa &&
        !fem::is_beside_load(responses, body, analysis.loads.unit_loads, {{place.node}})) {
      place.is_resolved = true;
      place.error_Pa =
          submodel_error_Pa({{{place.node, 1.0}}, analysis.envelope.von_mises.instant[place.node]}, responses,
                            body, analysis.loads, analysis.places.excluded);
    }
}

/// Cells on the quarter of a fillet; 0 for other places.
int cells_on(const BodyScene& body, const std::string& feature) {
  const auto names = fillets_of(body);
  const auto fillet = std::find(names.begin(), names.end(), feature);
  return fillet == names.end() ? 0 : body.shaft()->mesh.cells_at(int(fillet - names.begin()));
}

std::vector<PlaceStress> weld_toes(const BodyAnalysis& analysis) {
  std::vector<PlaceStress> places;
  for (const auto& spot : analysis.hot_spots) {
    const double own_Pa = own_error_Pa(analysis, stress_point(spot));
    places.push_back({spot.name, spot.near_node, spot.von_mises_Pa,
                      spot.resolved ? own_Pa : std::min(own_Pa, largest_error_of_toes * spot.von_mises_Pa),
                      spot.toe_m, spot.resolved != nullptr});
  }
  return places;
}

}  // namespace

std::vector<PlaceStress> places_of_one_mesh(const BodyAnalysis& analysis) {
  const auto& maximum = analysis.envelope.von_mises;
  auto places =
      largest_by_feature(analysis.responses.nodes, maximum.value_Pa, analysis.mesh.features, analysis.places);
  const double largest_Pa = governing_stress(analysis).value_Pa;
  for (auto& place : places) {
    if (place.value_Pa < worth_a_look * largest_Pa) {
      place.error_Pa = place.value_Pa;
      continue;
    }
    place.error_Pa = own_error_Pa(analysis, {{{place.node, 1.0}}, maximum.instant[place.node]});
    if (const int cells = cells_on(analysis.scene, place.feature); cells > 0)
      place.error_Pa = std::max(place.error_Pa, for_want_of_cells(cells) * place.value_Pa);
  }
  ask_submodels(analysis, largest_Pa, places);
  const auto toes = weld_toes(analysis);
  places.insert(places.end(), toes.begin(), toes.end());
  return places;
}

void take_place_errors(BodyAnalysis& analysis, const std::vector<PlaceStress>& judged,
                       const std::string& method) {
  if (judged.empty()) return;
  const auto judgement = judge(judged);
  auto& errors = errors_of_governing(analysis);
  errors.set_numerical({"discretisation", method, judged[judgement.governing].error_Pa});
  errors.set_numerical({"other_places",
                        judgement.other_place.empty()
                            ? "no other place exceeds it, with its own error"
                            : fmt::format("{} with its own error exceeds it by that", judgement.other_place),
                        judgement.other_places_Pa});
  analysis.place_stresses = judged;
  for (auto& zone : analysis.zones.zones)
    for (const auto& place : judged)
      if (place.feature == zone.feature && place.value_Pa > 0)
        zone.error_Pa = place.error_Pa * zone.peak_Pa / place.value_Pa;
}

}  // namespace pipelines
