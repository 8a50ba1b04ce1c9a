/// Delaunay leaves a few flat cells, and curving turns a few more inside out; moving inner nodes opens both.
#pragma once

#include "meshes/values/cell_mesh.h"

namespace meshes {

/// Moves inner nodes of quadratic tetrahedra, one after the other, so that the worst cell around each gets
/// better, until the cells have the scaled Jacobian wanted or nothing moves. A corner takes the inner middles
/// of its edges halfway along. Nodes on the boundary, and between volumes, stay; all do where three cells in
/// ten are worse than that.
void move_inner_nodes(CellMesh& mesh, double wanted);

}  // namespace meshes
