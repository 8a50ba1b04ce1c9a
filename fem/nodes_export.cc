#include "fem/nodes_export.h"

#include "fem/cell_geometry.h"
#include "fem/vtk_order.h"

namespace fem {

Nodes export_nodes(const Grid& grid, const NodeIntegrals& integrals) {
  Nodes nodes;
  nodes.n = grid.n_nodes;
  nodes.xyz_m = grid.xyz_m;
  nodes.volume_m3.resize(grid.n_nodes);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) nodes.volume_m3[i] = integrals(i, 0);
  if (grid.degree != 2) return nodes;

  nodes.cells.resize(grid.n_cells());
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (std::size_t v = 0; v < 27; ++v)
      nodes.cells[c][v] = grid.nodes_of(c)[vtk_hexahedron_from_lexicographic[v]];
  for (const auto& face : grid.boundary) {
    const auto lexicographic = nodes_of_face(grid, face.cell, face.face);
    auto& quad = nodes.faces.emplace_back();
    for (std::size_t v = 0; v < 9; ++v) quad[v] = lexicographic[vtk_quad_from_lexicographic[v]];
    nodes.face_boundary_id.push_back(face.boundary_id);
  }
  return nodes;
}

}  // namespace fem
