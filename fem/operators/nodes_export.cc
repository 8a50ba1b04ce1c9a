#include "fem/operators/nodes_export.h"

#include "fem/mesh/cell_geometry.h"
#include "fem/operators/material_interfaces.h"
#include "fem/triangulation/body_grid.h"
#include "fem/values/body_nodes.h"
#include "fem/values/vtk_order.h"

namespace fem {

Nodes export_nodes(const Grid& grid, const NodeIntegrals& integrals) {
  Nodes nodes = export_nodes(grid);
  nodes.volume_m3.resize(grid.n_nodes);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) nodes.volume_m3[i] = integrals(i, 0);
  return nodes;
}

Nodes export_nodes(const Grid& grid) {
  Nodes nodes;
  nodes.n = grid.n_nodes;
  nodes.xyz_m = grid.xyz_m;
  nodes.kind = grid.kind;
  nodes.degree = grid.degree;
  const int *hexahedron = vtk_hexahedron_order(grid.degree), *quad = vtk_quad_order(grid.degree);
  const bool as_they_are = grid.kind == CellKind::tetrahedra;
  nodes.cells.reserve(grid.cell_nodes.size());
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (std::size_t v = 0; v < nodes.nodes_per_cell(); ++v)
      nodes.cells.push_back(grid.nodes_of(c)[as_they_are ? v : std::size_t(hexahedron[v])]);
  nodes.cell_volume_id.assign(grid.volume_id.begin(), grid.volume_id.end());
  nodes.faces.reserve(grid.boundary.size() * nodes.nodes_per_face());
  for (const auto& face : grid.boundary) {
    const auto local = nodes_of_face(grid, face.cell, face.face);
    for (std::size_t v = 0; v < nodes.nodes_per_face(); ++v)
      nodes.faces.push_back(local[as_they_are ? v : std::size_t(quad[v])]);
    nodes.face_boundary_id.push_back(face.boundary_id);
  }
  return nodes;
}

NodeRows sum_of_channels(const std::vector<double>& of_channels, int n_components,
                         const std::vector<std::int32_t>& nodes, const Eigen::MatrixXd& factors) {
  NodeRows sum(Eigen::Index(nodes.size()), n_components * factors.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto first = std::size_t(nodes[i]) * std::size_t(n_components * factors.rows());
    const Eigen::Map<const Eigen::MatrixXd> unit(&of_channels[first], n_components, factors.rows());
    Eigen::Map<Eigen::MatrixXd>(&sum(Eigen::Index(i), 0), n_components, factors.cols()).noalias() =
        unit * factors;
  }
  return sum;
}

Nodes body_nodes(const Body& body) {
  const Grid grid = make_grid(body);
  return export_nodes(grid_of_stress(grid, CellMaterials(grid, body)));
}

}  // namespace fem
