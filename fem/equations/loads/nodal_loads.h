/// The load vectors of a body as plain nodal forces, for other finite-element codes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// What Model::unit_responses solves for.
struct NodalLoads {
  Nodes nodes;                         ///< as those of the unit responses
  std::vector<double> force_N;         ///< K x n x 3: load after load, each closed by a rigid-mode body force
  std::array<std::int64_t, 6> held{};  ///< unknowns 3 node + component of a statically determinate support at
                                       ///< three corners, ascending; it carries nothing
};

/// @param loads  each balanced as Model::unit_responses balances it, f - M R (R'MR)^-1 R'f
/// @throws std::invalid_argument for a body with clamps or elastic supports, whose forces are no load vector;
/// for the loads as Model::unit_responses
/// @throws MeshUnusable as Model, for the mesh
NodalLoads nodal_loads(const Body& body, const std::vector<UnitLoad>& loads);

}  // namespace fem
