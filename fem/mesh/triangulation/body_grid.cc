#include "fem/mesh/triangulation/body_grid.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "fem/base/values/errors.h"
#include "fem/base/values/vtk_order.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/connected_pieces.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/triangulation/array_checks.h"
#include "fem/mesh/triangulation/local_refinement.h"
#include "fem/mesh/triangulation/manifolds.h"
#include "fem/mesh/triangulation/tetrahedra_grid.h"
#include "fem/mesh/triangulation/triangulation.h"

namespace fem {

namespace {

Grid grid_of_tetrahedra(const Body& body) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("the mesh has quadratic tetrahedra: " + what);
  };
  if (!body.cylinders.empty() || !body.tori.empty())
    refuse("they are curved as they are; charts are for hexahedra");
  if (!body.refinements.empty()) refuse("only hexahedra are refined locally");
  if (body.degree != 2) refuse("degree = " + std::to_string(body.degree) + " must be 2");
  Grid grid = tetrahedra_grid(*body.mesh);
  refuse_inverted_cells(grid);
  refuse_several_pieces(grid);
  return grid;
}

/// The cells before any refinement, without their surface.
Grid linear_hexahedra(const CoarseMesh& mesh) {
  Grid grid;
  grid.degree = 1;
  grid.n_nodes = mesh.points_m.size();
  for (const auto& point : mesh.points_m) grid.xyz_m.insert(grid.xyz_m.end(), point.begin(), point.end());
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    for (const int corner : vtk_linear_hexahedron_from_lexicographic)  // gmsh has VTK's order
      grid.cell_nodes.push_back(mesh.cell(c)[corner]);
  grid.volume_id = mesh.volume_id;
  return grid;
}

/// Looks at all cells once; a mesh that is not refined has no larger ones.
void refuse_inverted(const dealii::Triangulation<3>& mesh, const Grid& grid) {
  const auto inverted = inverted_cells(grid);
  if (inverted.empty()) return;
  auto larger = larger_neighbours(mesh, inverted);
  if (larger.empty()) refuse_inverted_cells(grid);
  throw InvertedBesideLarger("local refinement inverts " + std::to_string(inverted.size()) +
                                 " cells beside larger ones: cut these too",
                             std::move(larger));
}

}  // namespace

Grid make_grid(const Body& body) {
  if (body.degree < 1 || body.degree > 3)
    throw std::invalid_argument("degree = " + std::to_string(body.degree) + ": must be 1, 2 or 3");
  if (!body.mesh) throw std::invalid_argument("the body has no mesh");
  check_arrays(*body.mesh);
  if (body.mesh->kind == CellKind::tetrahedra) return grid_of_tetrahedra(body);
  refuse_several_pieces(linear_hexahedra(*body.mesh));  // hanging faces match nowhere: before they are made
  dealii::Triangulation<3> mesh(dealii::Triangulation<3>::limit_level_difference_at_vertices);
  triangulate(*body.mesh, mesh);
  attach_charts(mesh, body.cylinders, body.tori);
  if (body.degree < 2 && !body.refinements.empty())
    throw std::invalid_argument(
        "cells of degree 1 are not refined locally: on a hanging face the chord of the larger cell may cut "
        "through the smaller ones");
  refine_locally(mesh, body.refinements);

  // One scalar space numbers the nodes: the unknowns of node i are 3 i, 3 i + 1, 3 i + 2. The mapping has the
  // same degree, so geometry and displacement share their nodes and rigid rotations are in the space exactly.
  const dealii::FE_Q<3> element(body.degree);
  dealii::DoFHandler<3> nodes(mesh);
  nodes.distribute_dofs(element);
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(body.degree);
  std::vector<dealii::Point<3>> support_points;
  for (const auto i : hierarchic) support_points.push_back(element.get_unit_support_points()[i]);
  const dealii::MappingQ<3> mapping(body.degree);
  dealii::FEValues<3> values(mapping, element, dealii::Quadrature<3>(support_points),
                             dealii::update_quadrature_points);

  Grid grid;
  grid.degree = body.degree;
  auto numbering = number_nodes(nodes);
  grid.n_nodes = numbering.n_nodes;
  grid.hanging = std::move(numbering.hanging);
  grid.xyz_m.resize(3 * grid.n_nodes);
  grid.cell_nodes.reserve(mesh.n_active_cells() * support_points.size());
  std::vector<dealii::types::global_dof_index> numbers(support_points.size());
  for (const auto& cell : nodes.active_cell_iterators()) {
    values.reinit(cell);
    cell->get_dof_indices(numbers);
    for (std::size_t i = 0; i < support_points.size(); ++i) {
      const auto node = std::size_t(numbering.of_dof[numbers[hierarchic[i]]]);
      grid.cell_nodes.push_back(static_cast<std::int32_t>(node));
      for (int d = 0; d < 3; ++d) grid.xyz_m[3 * node + d] = values.quadrature_point(i)[d];
    }
    for (const auto face : cell->face_indices())
      if (cell->face(face)->at_boundary())
        grid.boundary.push_back({static_cast<std::int32_t>(grid.n_cells()), static_cast<int>(face),
                                 static_cast<int>(cell->face(face)->boundary_id())});
    grid.volume_id.push_back(static_cast<int>(cell->material_id()));
  }
  // Faces between cells of unlike size have one shape for both, so that rigid rotations stay in the space.
  set_hanging_rows(grid.hanging, Eigen::Map<NodeRows>(grid.xyz_m.data(), Eigen::Index(grid.n_nodes), 3));
  refuse_inverted(mesh, grid);
  return grid;
}

}  // namespace fem
