#include "fem/mesh/triangulation.h"

#include <deal.II/grid/grid_tools.h>

#include <array>
#include <string>
#include <vector>

#include "fem/values/errors.h"

namespace fem {

namespace {

/// gmsh's place of deal.II's lexicographic corner.
constexpr std::array<int, 8> gmsh_corner = {0, 1, 3, 2, 4, 5, 7, 6};

}  // namespace

void triangulate(const CoarseMesh& mesh, dealii::Triangulation<3>& triangulation) {
  std::vector<dealii::Point<3>> points;
  points.reserve(mesh.points_m.size());
  for (const auto& [x_m, y_m, z_m] : mesh.points_m) points.emplace_back(x_m, y_m, z_m);
  std::vector<dealii::CellData<3>> cells(mesh.n_cells());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < gmsh_corner.size(); ++i)
      cells[c].vertices[i] = unsigned(mesh.cell(c)[gmsh_corner[i]]);
    cells[c].material_id = dealii::types::material_id(mesh.volume_id[c]);
  }
  dealii::SubCellData boundary;
  boundary.boundary_quads.resize(mesh.n_faces());
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    auto& quad = boundary.boundary_quads[f];
    for (std::size_t i = 0; i < 4; ++i) quad.vertices[i] = unsigned(mesh.face(f)[gmsh_corner[i]]);
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
