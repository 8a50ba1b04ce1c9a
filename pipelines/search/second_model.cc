#include "pipelines/search/second_model.h"

#include "fem/beam/beam_responses.h"
#include "pipelines/cheap_models/axisymmetric_body.h"
#include "pipelines/cheap_models/axisymmetric_run.h"
#include "pipelines/cheap_models/cheap_responses.h"
#include "pipelines/scene/why_not.h"

namespace pipelines {
namespace {

/// Its accuracy, relative to the largest stress; an eccentric shaft's model error is larger by far.
constexpr double target_if_exact = 2e-3, target_of_a_guide = 1e-2;
/// What nodes around the axis can miss of a peak of m = 1 between two of them: 1 - cos(pi / n), n = 48.
constexpr double between_angles = 2.2e-3;

}  // namespace

std::optional<SecondModel> axisymmetric_second_model(const BodyScene& body, const MeshedBody& meshed,
                                                     const BodyLoads& loads, int n_threads) {
  if (!why_not_axisymmetric(body).empty()) return std::nullopt;
  SecondModel result;
  if (const auto beam = beam_shaft(body, meshed.mesh)) result.model_error = fem::eccentricity_error(*beam);
  const double target = result.model_error > 0 ? target_of_a_guide : target_if_exact;
  result.places = axisymmetric_place_stresses(body, meshed, loads, n_threads, target);
  for (auto& place : result.places) place.error_Pa += between_angles * place.value_Pa;
  return result;
}

}  // namespace pipelines
