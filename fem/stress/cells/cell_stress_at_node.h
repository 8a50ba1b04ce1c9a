/// Stress of the finite-element solution itself at a node, in each of the cells that meet there. How far the
/// cells are from the recovered stress shows how far the mesh is from resolving the place.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// @param node  index into responses.nodes
/// @return for each cell K tensors (xx, yy, zz, xy, yz, xz) [Pa], one per unit load
/// @throws std::invalid_argument if no cell holds the node
std::vector<std::vector<std::array<double, 6>>> cell_stress_at_node_Pa(const UnitResponses& responses,
                                                                       const Material& material,
                                                                       std::size_t node);

/// How far single cells are from the recovered stress, at every node that is asked for.
/// @param factors  one per node: where its load case stands, one factor per channel; null: not asked for
/// @return one per node: the largest difference of von Mises stress over the cells that meet there [Pa]; 0
/// where it was not asked for
std::vector<double> largest_cell_differences_Pa(const UnitResponses& responses, const Material& material,
                                                const std::vector<const double*>& factors);

}  // namespace fem
