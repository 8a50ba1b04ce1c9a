/// Recovered stress on a body's surface between its nodes: by the polynomials of its boundary faces.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace fem {

/// Stress of every unit load at one point, (xx, yy, zz, xy, yz, xz) [Pa].
using UnitStress = std::vector<std::array<double, 6>>;

/// At the points of an even grid, n intervals along each edge, on each of the boundary faces that hold a
/// node. Empty if there are none.
/// @param node      index into responses.nodes
/// @param left_out  one per node: a face with such a node is left out
std::vector<UnitStress> stress_on_faces_around_Pa(const UnitResponses& responses, std::size_t node, int n,
                                                  const std::vector<char>& left_out);

/// What a node's value contributes at a point of the surface.
struct NodeShare {
  std::size_t node = 0;
  double weight = 1;
};

struct PointOnBoundary {
  std::size_t face = 0;           ///< index among the boundary faces
  std::vector<NodeShare> shares;  ///< one node where one lies there, else the face's by their shape functions
};

/// A point of the surface by the boundary face that holds it; of two that share it, the first.
/// @param at_m   the point
/// @param off_m  what it may be off the meshed surface by
/// @return no shares if no face comes so near
PointOnBoundary point_on_boundary(const Nodes& nodes, const std::array<double, 3>& at_m, double off_m);

}  // namespace fem
