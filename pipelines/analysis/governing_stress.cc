#include "pipelines/analysis/governing_stress.h"

#include <algorithm>

namespace pipelines {
namespace {

/// The yield strength is the same all over a body: the larger stress has the smaller safety.
bool hot_spot_governs(const BodyAnalysis& analysis) {
  return !analysis.hot_spots.empty() && analysis.hot_spots.front().von_mises_Pa > analysis.peak.value_Pa;
}

/// What a more expensive model than a beam or harmonics would lower, as a share of the body's peak; 0 of a
/// solid.
double share_of_cheap_model(const BodyAnalysis& analysis) {
  const auto& peak = analysis.peak;
  return peak.value_Pa > 0 ? (peak.errors.reducible_Pa() - peak.errors.numerical_Pa()) / peak.value_Pa : 0;
}

}  // namespace

std::string GoverningStress::name() const {
  return kind == Kind::hot_spot ? "hot-spot stress" : "peak von Mises stress";
}

GoverningStress governing_stress(const BodyAnalysis& analysis) {
  GoverningStress stress;
  if (hot_spot_governs(analysis)) {
    const auto& spot = analysis.hot_spots.front();
    stress.kind = GoverningStress::Kind::hot_spot;
    stress.place = spot.name;
    stress.surface = Place::free_surface;
    stress.position_m = spot.toe_m;
    stress.instant = spot.instant;
    stress.value_Pa = spot.von_mises_Pa;
    stress.errors = analysis.hot_spot_errors;
  } else {
    const auto& peak = analysis.peak;
    stress.place = peak.feature;
    stress.surface = peak.place;
    stress.position_m = peak.position_m;
    stress.instant = peak.instant;
    stress.value_Pa = peak.value_Pa;
    stress.errors = peak.errors;
  }
  stress.safety = analysis.scene.yield_strength_Pa / stress.value_Pa;
  return stress;
}

ErrorBudget& errors_of_governing(BodyAnalysis& analysis) {
  return hot_spot_governs(analysis) ? analysis.hot_spot_errors : analysis.peak.errors;
}

std::optional<double> error_Pa(const BodyAnalysis& analysis, const Zone& zone) {
  if (zone.peak_node == analysis.peak.node) return analysis.peak.errors.reducible_Pa();
  if (!zone.error_Pa) return std::nullopt;
  return *zone.error_Pa + share_of_cheap_model(analysis) * zone.peak_Pa;
}

double error_Pa(const BodyAnalysis& analysis, const PlaceStress& place) {
  return place.error_Pa + share_of_cheap_model(analysis) * place.value_Pa;
}

double error_Pa(const BodyAnalysis& analysis, const HotSpotStress& spot) {
  const HotSpotStress& first = analysis.hot_spots.front();
  const ErrorBudget& errors = analysis.hot_spot_errors;
  if (spot.name == first.name) return errors.numerical_Pa();
  // A place is judged by its mesh alone: the instants, the pressure's harmonics and the rest are as for the
  // first toe.
  const double rest_Pa = errors.numerical_Pa() - errors.of("discretisation") - errors.of("other_places");
  for (const auto& place : analysis.place_stresses)
    if (place.feature == spot.name)
      return place.error_Pa +
             (first.von_mises_Pa > 0 ? std::max(0.0, rest_Pa) / first.von_mises_Pa * spot.von_mises_Pa : 0);
  return spot.error_Pa;
}

}  // namespace pipelines
