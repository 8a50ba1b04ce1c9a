#include "pipelines/write/living/page_places.h"

#include <algorithm>
#include <cmath>

#include "pipelines/judge/analysis/governing_stress.h"

namespace pipelines {
namespace {

constexpr std::size_t most_zones = 16, most_toes = 24;

PagePlace place_of(const Judged& analysis, const Zone& zone) {
  PagePlace place{"zone",       zone.feature, to_string(zone.place), zone.peak_m,
                  zone.peak_Pa, -1,           zone.instant,          {}};
  place.point.parts = {{zone.peak_node, 1}};
  if (const auto error = error_Pa(analysis, zone)) place.error_Pa = *error;
  return place;
}

PagePlace place_of(const Judged& analysis, const HotSpotStress& toe) {
  PagePlace place{"toe",       toe.name,         "weld toe, hot-spot stress", toe.toe_m, toe.von_mises_Pa, -1,
                  toe.instant, stress_point(toe)};
  const double error = error_Pa(analysis, toe);
  if (std::isfinite(error)) place.error_Pa = error;
  return place;
}

PagePlace governing_place(const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  PagePlace place{"governing",     stress.place,
                  stress.name(),   stress.position_m,
                  stress.value_Pa, stress.errors.total_Pa(),
                  stress.instant,  {}};
  if (stress.kind == GoverningStress::Kind::hot_spot)
    place.point = stress_point(analysis.hot_spots.front());
  else
    place.point.parts = {{analysis.peak.node, 1}};
  if (!std::isfinite(place.error_Pa)) place.error_Pa = -1;
  return place;
}

}  // namespace

std::vector<PagePlace> page_places(const Judged& analysis) {
  std::vector<PagePlace> places{governing_place(analysis)};
  const auto& zones = analysis.zones.zones;
  for (std::size_t i = 0; i < std::min(zones.size(), most_zones); ++i)
    places.push_back(place_of(analysis, zones[i]));
  for (std::size_t i = 0; i < std::min(analysis.hot_spots.size(), most_toes); ++i)
    places.push_back(place_of(analysis, analysis.hot_spots[i]));
  return places;
}

}  // namespace pipelines
