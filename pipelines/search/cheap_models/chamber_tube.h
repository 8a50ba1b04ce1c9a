/// The cheapest model of a chamber: hot-spot stresses at the weld toes of its tube, taken as a thin shell
/// that webs and lugs load as rigid plates (fem/models/beam/plated_tube.h).
#pragma once

#include <optional>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/loads/stage/body_mesh.h"

namespace pipelines {

/// What hangs on a plate is passed on to the tube by statics: webs share the housing's loads evenly, both
/// lugs of a foot those of the foot; plates and pads bring their own inertia. Pressure inside the tube, the
/// tube's own inertia and what enters at the flanges strain the tube much less than the plates do and are
/// left out. Nodes are the points of the mesh's hot spots; no cells, no faces.
/// @return nothing if the body is no parametric chamber
std::optional<fem::UnitResponses> plated_tube_responses(const BodyScene& body, const MeshedBody& meshed,
                                                        const std::vector<fem::UnitLoad>& loads);

}  // namespace pipelines
