#include "pipelines/analysis/governing_stress.h"

namespace pipelines {
namespace {

/// The yield strength is the same all over a body: the larger stress has the smaller safety.
bool hot_spot_governs(const BodyAnalysis& analysis) {
  return !analysis.hot_spots.empty() && analysis.hot_spots.front().von_mises_Pa > analysis.peak.value_Pa;
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
  const auto& peak = analysis.peak;
  if (zone.peak_node == peak.node) return peak.errors.reducible_Pa();
  if (!zone.error_Pa || peak.value_Pa <= 0) return zone.error_Pa;
  const double of_model_Pa = peak.errors.reducible_Pa() - peak.errors.numerical_Pa();  // of a cheap one
  return *zone.error_Pa + of_model_Pa * zone.peak_Pa / peak.value_Pa;
}

double error_Pa(const BodyAnalysis& analysis, const HotSpotStress& spot) {
  if (spot.name == analysis.hot_spots.front().name) return analysis.hot_spot_errors.numerical_Pa();
  for (const auto& place : analysis.place_stresses)
    if (place.feature == spot.name) return place.error_Pa;
  return spot.error_Pa;
}

}  // namespace pipelines
