#include "fem/equations/operators/nodes_export.h"

#include "fem/base/values/body_nodes.h"
#include "fem/base/values/vtk_order.h"
#include "fem/equations/operators/sharp_edges.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/triangulation/body_grid.h"

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

namespace {

int n_components(NodalField field) {
  return field == NodalField::displacement ? 3 : 6;
}

/// @param unit  channels x components
void sum(const double* unit, int n_components, const Eigen::MatrixXd& factors, double* row) {
  const Eigen::Map<const Eigen::MatrixXd> of_channels(unit, n_components, factors.rows());
  Eigen::Map<Eigen::MatrixXd>(row, n_components, factors.cols()).noalias() = of_channels * factors;
}

}  // namespace

NodeRows sum_of_channels(const UnitResponses& responses, NodalField field,
                         const std::vector<std::int32_t>& nodes, const Eigen::MatrixXd& factors) {
  responses.bring(nodes);
  NodeRows rows(Eigen::Index(nodes.size()), n_components(field) * factors.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum(field == NodalField::stress ? responses.stress_anywhere_Pa(std::size_t(nodes[i]))
                                    : responses.displacement_anywhere_m(std::size_t(nodes[i])),
        n_components(field), factors, &rows(Eigen::Index(i), 0));
  return rows;
}

NodeRows sum_of_own_channels(const UnitResponses& responses, NodalField field,
                             const Eigen::MatrixXd& factors) {
  NodeRows rows(Eigen::Index(responses.n_rows()), n_components(field) * factors.cols());
  for (std::size_t row = 0; row < responses.n_rows(); ++row) {
    const std::size_t node = responses.node_of_row(row);
    sum(field == NodalField::stress ? responses.unit_stress_Pa(node) : responses.unit_displacement_m(node),
        n_components(field), factors, &rows(Eigen::Index(row), 0));
  }
  return rows;
}

Nodes body_nodes(const Body& body) {
  const Grid grid = make_grid(body);
  return export_nodes(split_at_sharp_edges(grid, cells_of_nodes(grid)).grid);
}

}  // namespace fem
