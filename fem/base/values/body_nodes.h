/// The shape of a body without a model of it.
#pragma once

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// Nodes, cells and boundary faces as the model of the body has them, curved by its charts; without the
/// nodes' volumes. Needs no Environment.
/// @throws as Model, for the mesh
Nodes body_nodes(const Body& body);

}  // namespace fem
