#include "pipelines/judge/analysis/governing_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/fitted.h"

namespace pipelines {
namespace {

/// The yield strength is the same all over a body: the larger stress has the smaller safety.
bool hot_spot_governs(const Judged& analysis) {
  return !analysis.hot_spots.empty() && analysis.hot_spots.front().von_mises_Pa > analysis.peak.value_Pa;
}

/// What a more expensive model than a beam or harmonics would lower, as a share of the body's peak; 0 of a
/// solid.
double share_of_cheap_model(const Judged& analysis) {
  const auto& peak = analysis.peak;
  return peak.value_Pa > 0 ? (peak.errors.reducible_Pa() - peak.errors.numerical_Pa()) / peak.value_Pa : 0;
}

/// Whether a height is on an eccentric segment, or within its diameter of one: farther away what its offset
/// changes has died out.
bool is_beside_eccentric_segment(const Responded& analysis, double z_m) {
  const auto& planes = analysis.mesh.sections;
  return std::any_of(planes.begin(), planes.end(), [&](const auto& plane) {
    return std::hypot(plane.axis_x_m, plane.axis_y_m) > 0 && std::abs(z_m - plane.z_m) <= 2 * plane.radius_m;
  });
}

/// What a more expensive model would lower of a stress at a height. Harmonics take eccentric segments as
/// concentric: what that costs at their fillets it costs in pascals beside them, too. The seat and its
/// shoulders, which the offset brings nearer to the flow of bending, had 19.0 and 14.2 MPa where the solid
/// has 22.2 and 18.9, and the fillets 98.6 where it has 103.5.
double error_of_cheap_model_Pa(const Judged& analysis, double value_Pa, double z_m, double times = 1) {
  const double share = share_of_cheap_model(analysis), own_Pa = share * value_Pa;
  if (analysis.method != Method::axisymmetric || !(share > 0) || !is_beside_eccentric_segment(analysis, z_m))
    return own_Pa;
  double largest_Pa = value_Pa;  // beside eccentric segments
  for (const auto& place : analysis.place_stresses)
    if (is_beside_eccentric_segment(analysis, place.position_m[2]))
      largest_Pa = std::max(largest_Pa, place.value_Pa);
  const auto& errors = analysis.peak.errors;
  const double of_segments_Pa =
      errors.of("eccentric_segments") / analysis.peak.value_Pa * largest_Pa + errors.of("offset_axis");
  return std::max(own_Pa, times * of_segments_Pa);
}

double of_load_patches_Pa(const ErrorBudget& errors) {
  return errors.of("load_patches") + errors.of("charge_patch");
}

/// The errors of assumptions, but for load patches.
double without_load_patches_Pa(const ErrorBudget& errors) {
  return errors.total_Pa() - errors.numerical_Pa() - of_load_patches_Pa(errors);
}

bool is_maximum_of_its_place(const Judged& analysis, const std::string& feature, std::size_t node) {
  return std::none_of(analysis.place_stresses.begin(), analysis.place_stresses.end(),
                      [&](const auto& place) { return place.feature == feature && place.node != node; });
}

}  // namespace

std::string GoverningStress::name() const {
  return kind == Kind::hot_spot ? "hot-spot stress" : "peak von Mises stress";
}

GoverningStress governing_stress(const Judged& analysis) {
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

ErrorBudget& errors_of_governing(Judged& analysis) {
  return hot_spot_governs(analysis) ? analysis.hot_spot_errors : analysis.peak.errors;
}

std::optional<double> error_Pa(const Judged& analysis, const Zone& zone) {
  if (zone.peak_node == analysis.peak.node) return analysis.peak.errors.reducible_Pa();
  if (!zone.error_Pa) return std::nullopt;
  return *zone.error_Pa +
         error_of_cheap_model_Pa(analysis, zone.peak_Pa, zone.peak_m[2],
                                 is_maximum_of_its_place(analysis, zone.feature, zone.peak_node)
                                     ? 1
                                     : fitted::times_elsewhere_on_fillet);
}

double error_Pa(const Judged& analysis, const PlaceStress& place) {
  return place.error_Pa + error_of_cheap_model_Pa(analysis, place.value_Pa, place.position_m[2]);
}

double model_error_share(const Judged& analysis, const std::string& feature, std::size_t node) {
  const auto& peak = analysis.peak;
  if (!(peak.value_Pa > 0)) return 0;
  const double all = without_load_patches_Pa(peak.errors) / peak.value_Pa,
               of_loads = all - share_of_cheap_model(analysis);
  const double value_Pa = analysis.envelope.von_mises.value_Pa[node];
  if (!(value_Pa > 0)) return all;
  return of_loads + error_of_cheap_model_Pa(analysis, value_Pa, analysis.responses.nodes.xyz_m[3 * node + 2],
                                            is_maximum_of_its_place(analysis, feature, node)
                                                ? 1
                                                : fitted::times_elsewhere_on_fillet) /
                        value_Pa;
}

double stated_error_share(const Judged& analysis, const std::string& feature) {
  const auto& peak = analysis.peak;
  return feature == peak.feature && peak.value_Pa > 0 ? peak.errors.total_Pa() / peak.value_Pa : 0;
}

double whole_error_share(const Judged& analysis, const HotSpotStress& spot) {
  const bool is_judged = std::any_of(analysis.place_stresses.begin(), analysis.place_stresses.end(),
                                     [&](const auto& place) { return place.feature == spot.name; });
  if (!is_judged) return std::numeric_limits<double>::infinity();
  const double first_Pa = analysis.hot_spots.front().von_mises_Pa;
  if (!(first_Pa > 0) || !(spot.von_mises_Pa > 0)) return 0;
  const auto& errors = analysis.hot_spot_errors;
  const double patches_Pa =
      spot.name == analysis.hot_spots.front().name
          ? of_load_patches_Pa(errors)
          : load_patch_error_Pa(analysis, stress_point(spot), analysis.loads.history.values);
  return (error_Pa(analysis, spot) + patches_Pa) / spot.von_mises_Pa +
         without_load_patches_Pa(errors) / first_Pa;
}

double error_Pa(const Judged& analysis, const HotSpotStress& spot) {
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
