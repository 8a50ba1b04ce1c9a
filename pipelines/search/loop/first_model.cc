#include "pipelines/search/loop/first_model.h"

#include <new>

#include "fem/beam/beam_responses.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/beam_run.h"
#include "pipelines/search/cheap_models/cheap_responses.h"

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

std::optional<SecondModel> second_model_of(const BodyScene& body, const MeshedBody& meshed,
                                           const BodyLoads& loads, double tolerance, int n_threads,
                                           double seconds) {
  std::optional<SecondModel> model;
  try {
    const auto refusal = refusal_of([&] {
      in_time(seconds, [&] { model = axisymmetric_second_model(body, meshed, loads, tolerance, n_threads); });
    });
    if (refusal.empty()) return model;
  } catch (const std::bad_alloc&) {  // a strict tolerance asks for fine sections
  }
  return std::nullopt;
}

SearchStep step_of(const Scene& scene, std::size_t i_body, const GoverningStress& stress,
                   const BodyAnalysis& analysis, double seconds) {
  return {fineness_text(scene.bodies[i_body]),
          "",
          stress.place,
          scene.sampling.instants_per_turn,
          scene.bodies[i_body].pressure_harmonics,
          analysis.responses.n_dofs,
          stress.value_Pa,
          stress.errors,
          analysis.envelope.principal.value_Pa[analysis.principal_node],
          seconds,
          peak_memory_gigabytes()};
}

Search search_of_beam(const Scene& scene, std::size_t i_body, const BodyAnalysis& analysis,
                      double tolerance) {
  const auto stress = governing_stress(analysis);
  Search search;
  search.quantity = stress.name();
  search.tolerance = tolerance;
  search.steps = {step_of(scene, i_body, stress, analysis, analysis.solve_s)};
  search.steps.back().fineness = "beam";
  search.met = stress.errors.reducible_Pa() <= tolerance * stress.value_Pa;
  search.ended = search.met ? "the tolerance is met"
                            : "a beam has no mesh to refine (method \"auto\" takes a finer model)";
  return search;
}

}  // namespace pipelines
