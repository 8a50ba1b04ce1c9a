/// Curved cells where faces meet at a zero angle.
#pragma once

#include <vector>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// In a wedge between faces that are tangent no curved cell is right: its faces would touch along the edge.
/// Edges on the boundary lose as much of their curvature as the cells that are worse than wanted cannot bear,
/// up to all of it; where that makes a cell beside them worse than wanted, its edges follow.
/// @return the edges that have left the part's surface, in the order of their nodes
std::vector<StraightEdge> straighten_edges(CellMesh& mesh, double wanted);

}  // namespace meshes
