#include "tests/benchmarks/promises/reference.h"

#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"

namespace promises {
namespace {

using namespace pipelines;

constexpr std::size_t most_unknowns = 400000;  // of a section that another one follows

Reference by_places(const std::vector<PlaceStress>& places) {
  Reference result;
  for (const auto& place : places) {
    result.places[place.feature] = place.value_Pa;
    result.errors[place.feature] = place.error_Pa;
    if (place.value_Pa <= result.peak_Pa) continue;
    result.peak_Pa = place.value_Pa;
    result.feature = place.feature;
    result.change = place.error_Pa / place.value_Pa;
  }
  return result;
}

}  // namespace

Reference axisymmetric_reference(const Scene& scene, double wanted) {
  Scene with_harmonics = scene;
  auto& body = with_harmonics.bodies.front();
  body.pressure_harmonics *= 3;
  StageClock clock;
  const auto loaded = load_bodies(with_harmonics, {describe_revolved(body)}, clock);
  return by_places(
      axisymmetric_stresses(body, loaded.meshed.front(), loaded.body_loads.front(), 2, wanted, most_unknowns)
          .places);
}

}  // namespace promises
