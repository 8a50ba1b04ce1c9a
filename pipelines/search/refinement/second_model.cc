#include "pipelines/search/refinement/second_model.h"

#include <algorithm>

#include "fem/models/beam/beam_responses.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/search/cheap_models/fitted.h"

namespace pipelines {
namespace {

/// Accuracy, relative to the largest stress: a share of the tolerance, between these.
constexpr double share_of_tolerance = 0.1, best_accuracy = 2e-3, worst_accuracy = 1e-2;
/// Reached by the first section, whatever it is.
constexpr double any_accuracy = 10;

}  // namespace

std::optional<SecondModel> axisymmetric_second_model(const BodyScene& solid, const MeshedBody& meshed,
                                                     const BodyLoads& loads, double tolerance,
                                                     int n_threads) {
  BodyScene body = solid;
  body.natural_frequencies = 0;  // those of the solid: its stresses are compared all the same
  if (!why_not_axisymmetric(body).empty()) return std::nullopt;
  SecondModel result;
  if (const auto beam = beam_shaft(body, meshed.mesh)) result.model_error = fem::eccentricity_error(*beam);
  const bool is_guide = result.model_error > 0;
  const double accuracy =
      is_guide ? any_accuracy : std::clamp(share_of_tolerance * tolerance, best_accuracy, worst_accuracy);
  auto stresses = axisymmetric_stresses(body, meshed, loads, n_threads, accuracy);
  result.places = std::move(stresses.places);
  result.torsion = stresses.torsion;
  result.torsion.error_Pa += result.model_error * result.torsion.value_Pa;
  if (is_guide)
    for (auto& place : result.places) place.error_Pa = fitted::error_of_guide * place.value_Pa;
  return result;
}

}  // namespace pipelines
