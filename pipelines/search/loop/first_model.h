/// Which model of a body is tried first, and how a step of its search is recorded.
#pragma once

#include <optional>

#include "pipelines/judge/analysis/body_analysis.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/search/refinement/second_model.h"

namespace pipelines {

/// The model that is asked for; with the choice left open the cheapest whose own error is within the
/// tolerance.
/// @param tolerance  of the governing stress; 0: none is asked for, and the choice is the solid
Method first_method(const Scene& scene, std::size_t i_body, double tolerance);

/// axisymmetric_second_model where it applies, fits into memory and is found in time: the solid can do
/// without.
/// @param seconds  that it may take; infinite: no limit
std::optional<SecondModel> second_model_of(const BodyScene& body, const MeshedBody& meshed,
                                           const BodyLoads& loads, double tolerance, int n_threads,
                                           double seconds);

/// What a search keeps of its present mesh.
SearchStep step_of(const Scene& scene, std::size_t i_body, const GoverningStress& stress,
                   const BodyAnalysis& analysis, double seconds);

/// The search of a beam, which is as good as it is: one step, which meets the tolerance or not.
Search search_of_beam(const Scene& scene, std::size_t i_body, const BodyAnalysis& analysis, double tolerance);

}  // namespace pipelines
