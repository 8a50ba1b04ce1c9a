#include "fem/mesh/triangulation/triangulation.h"

#include <deal.II/grid/grid_tools.h>

#include <string>
#include <vector>

#include "fem/base/values/errors.h"
#include "fem/base/values/vtk_order.h"

namespace fem {

void triangulate(const CoarseMesh& mesh, dealii::Triangulation<3>& triangulation) {
  // gmsh has VTK's order, deal.II the lexicographic one.
  constexpr auto hexahedron = vtk_linear_hexahedron_from_lexicographic;
  constexpr auto quad_order = vtk_linear_quad_from_lexicographic;
  std::vector<dealii::Point<3>> points;
  points.reserve(mesh.points_m.size());
  for (const auto& [x_m, y_m, z_m] : mesh.points_m) points.emplace_back(x_m, y_m, z_m);
  std::vector<dealii::CellData<3>> cells(mesh.n_cells());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < 8; ++i) cells[c].vertices[i] = unsigned(mesh.cell(c)[hexahedron[i]]);
    cells[c].material_id = dealii::types::material_id(mesh.volume_id[c]);
  }
  dealii::SubCellData boundary;
  boundary.boundary_quads.resize(mesh.n_faces());
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    auto& quad = boundary.boundary_quads[f];
    for (std::size_t i = 0; i < 4; ++i) quad.vertices[i] = unsigned(mesh.face(f)[quad_order[i]]);
    quad.boundary_id = dealii::types::boundary_id(mesh.face_id[f]);
  }
  try {
    dealii::GridTools::delete_unused_vertices(points, cells, boundary);
    dealii::GridTools::consistently_order_cells(cells);
    triangulation.create_triangulation(points, cells, boundary);
  } catch (const dealii::ExceptionBase& error) {
    throw MeshUnusable(std::string("the mesh cannot be joined to one body: ") + error.what());
  }
}

}  // namespace fem
