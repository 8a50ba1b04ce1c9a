/// Stress of the finite-element solution itself at a node: the plain mean over the cells that meet there.
/// Against the recovered stress it shows how far the mesh is from resolving the place.
#pragma once

#include <array>
#include <vector>

#include "fem/body.h"
#include "fem/unit_responses.h"

namespace fem {

/// @param node  index into responses.nodes
/// @return K tensors (xx, yy, zz, xy, yz, xz) [Pa], one per unit load
/// @throws std::invalid_argument if no cell holds the node
std::vector<std::array<double, 6>> mean_cell_stress_Pa(const UnitResponses& responses,
                                                       const Material& material, std::size_t node);

}  // namespace fem
