/// Meshes of quadratic tetrahedra, which deal.II's readers refuse. Internal to fem.
#pragma once

#include <string>

#include "fem/mesh/grid.h"
#include "fem/mesh/msh_file.h"

namespace fem {

/// Whether a file has tetrahedra of 4 or 10 nodes, or the triangles that bound the latter.
bool has_tetrahedra(const std::vector<int>& element_types);

/// Cells and nodes as they are in the file, groups as ids. Triangles inside the body are passed over.
/// @param name  of the file, for messages
/// @throws MeshUnusable for cells that are no tetrahedra of 10 nodes, a volume without a physical
/// group, a face of the surface without a triangle of 6 nodes in one
Grid tetrahedra_grid(const MshFile& mesh, const std::string& name);

}  // namespace fem
