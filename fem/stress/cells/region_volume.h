/// Volumes of parts of a body: where a field given at its nodes is at or above a level, and around each node.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace fem {

/// Every cell is split into tetrahedra between neighbouring nodes (8 of a quadratic tetrahedron; 6 k^3 of a
/// hexahedron of degree k in four ways, of which the mean counts), in which the field is linear: the level
/// cuts a plane off each of them. Their volumes, by the Jacobian at their corners, are positive wherever
/// cells are not inverted, and sum to the cell's own. (The integrals of the nodes' shape functions,
/// Nodes::volume_m3, do not measure regions: those of the corners of quadratic tetrahedra are negative.)
/// @param value     one per node
/// @param left_out  one per node; of a tetrahedron with such nodes, their share of it is left out too
/// @return the volume above the level in each cell [m^3]; empty without cells
std::vector<double> cell_volumes_above_m3(const Nodes& nodes, const std::vector<double>& value, double level,
                                          const std::vector<char>& left_out);

/// The same with the field curved within the cells: by the shape functions of their degree, in cells of
/// degree 1 by Hermite's cubic along their edges, with the mean slope around each node. The tetrahedra are
/// cut into eight. Cells with nodes left out are measured as above.
std::vector<double> curved_cell_volumes_above_m3(const Nodes& nodes, const std::vector<double>& value,
                                                 double level, const std::vector<char>& left_out);

/// A node's own piece of the body: a quarter of each of these tetrahedra around it. Positive, and their sum
/// is the body's volume: weights for norms and means over nodes.
/// @return one per node [m^3]
std::vector<double> nodal_volumes_m3(const Nodes& nodes);

/// The share of a tetrahedron where the linear field with these values at its corners is above 0.
double share_above_zero(std::array<double, 4> corners);

}  // namespace fem
