/// The cheap rungs of the ladder of fidelity: unit responses of a shaft in the solid's channels, so that
/// envelope, peak and places come out of the same functions as the solid's.
#pragma once

#include <optional>
#include <vector>

#include "fem/beam_shaft.h"
#include "fem/unit_responses.h"
#include "pipelines/body_scene.h"

namespace pipelines {

/// The shaft as a beam; nothing for other bodies, nor with keyways.
std::optional<fem::BeamShaft> beam_shaft(const BodyScene& body, const meshes::BodyMesh& mesh);

/// Beam theory with stress concentration factors (fem/beam_responses.h). Locate its nodes with the features,
/// ports and sharp edges of `mesh`.
/// @param mesh  of the same body: its boundary ids
/// @return nothing if the body is no shaft, or has keyways
/// @throws std::invalid_argument as fem::beam_responses
std::optional<fem::UnitResponses> beam_responses(const BodyScene& body, const meshes::BodyMesh& mesh,
                                                 const std::vector<fem::UnitLoad>& loads);

}  // namespace pipelines
