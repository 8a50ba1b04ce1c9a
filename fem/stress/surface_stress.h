/// Recovered stress on a body's surface between its nodes: by the polynomials of its boundary faces.
#pragma once

#include <array>
#include <vector>

#include "fem/values/unit_responses.h"

namespace fem {

/// Stress of every unit load at one point, (xx, yy, zz, xy, yz, xz) [Pa].
using UnitStress = std::vector<std::array<double, 6>>;

/// At the points of an even grid, n intervals along each edge, on each of the boundary faces that hold a
/// node. Empty if there are none.
/// @param node      index into responses.nodes
/// @param left_out  one per node: a face with such a node is left out
std::vector<UnitStress> stress_on_faces_around_Pa(const UnitResponses& responses, std::size_t node, int n,
                                                  const std::vector<char>& left_out);

}  // namespace fem
