#include "pipelines/search/models/first_method.h"

#include <utility>

#include "fem/models/beam/beam_responses.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/search/models/beam_model.h"
#include "pipelines/search/models/harmonics_model.h"
#include "pipelines/search/models/solid_model.h"

namespace pipelines {

Method first_method(const Scene& scene, std::size_t i_body, double tolerance) {
  const auto& body = scene.bodies[i_body];
  if (scene.method != Method::automatic) return scene.method;
  const bool is_asked = tolerance > 0 && body.natural_frequencies == 0;
  if (!is_asked || !why_not_axisymmetric(body).empty()) return Method::solid;
  const auto described = describe_revolved(body);
  const auto beam = beam_shaft(body, described.mesh);
  const double eccentric = beam ? fem::eccentricity_error(*beam) : 0;
  if (beam && why_not_beam(body).empty() && 3 * fem::beam_model_error(*beam) <= tolerance)
    return Method::beam;
  return eccentric < tolerance ? Method::axisymmetric : Method::solid;
}

Method after(Method method) {
  return method == Method::beam ? Method::axisymmetric : Method::solid;
}

bool is_without_mesh(Method method) {
  return method == Method::axisymmetric || method == Method::beam;
}

std::unique_ptr<BodyModel> model_of(Method method, RunOfBody run, Loaded loaded) {
  switch (method) {
    case Method::beam:
      return std::make_unique<BeamModel>(std::move(run), std::move(loaded));
    case Method::axisymmetric:
      return std::make_unique<HarmonicsModel>(std::move(run), std::move(loaded));
    default:
      return std::make_unique<SolidModel>(std::move(run), std::move(loaded));
  }
}

}  // namespace pipelines
