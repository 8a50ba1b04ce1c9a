/// Cells that lie flat under a smooth surface.
#pragma once

namespace meshes {

/// A straight tetrahedron with two faces on the same smooth surface is sound; once its nodes follow the
/// surface, both faces have one tangent plane along their common edge, and the cell is flat there however
/// fine the mesh. Such cells of gmsh's current first-order mesh get a node inside: on the edge opposite to
/// the common one, moved away from the surface, so that each of the halves has one face there. To be called
/// before the order is raised.
/// @returns how many nodes were added
int split_flat_cells();

}  // namespace meshes
