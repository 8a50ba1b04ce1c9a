/// From unit responses to what is known of a body: envelope, places, peak, zones, hot spots, diagrams, and
/// their errors.
#pragma once

#include <optional>

#include "pipelines/analysis/body_analysis.h"

namespace pipelines {

/// The second half of analyse_body: everything that follows from unit responses.
/// @param known  the envelope of these loads and responses, where it has been computed
/// @throws LoadsDoNotClose if the loads do not close to 1e-9 on the mesh
BodyAnalysis superpose_body(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                            BodyLoads loads, fem::UnitResponses responses, int n_threads, StageClock& clock,
                            std::optional<Envelope> known = std::nullopt);

}  // namespace pipelines
