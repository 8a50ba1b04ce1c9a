#include "fem/models/axisymmetric/meridian_mesh.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fem/mesh/grid/charts.h"

namespace fem {
namespace {

using Cell = dealii::Triangulation<2>::active_cell_iterator;

constexpr int most_cuts = 20;  // a millionth of the first cells: sizes below rounding end here

void create(const MeridianBody& body, dealii::Triangulation<2>& mesh) {
  std::vector<dealii::Point<2>> vertices;
  for (const auto& p : body.points_m) vertices.emplace_back(p[0], p[1]);
  std::vector<dealii::CellData<2>> cells;
  for (const auto& cell : body.cells) {
    dealii::CellData<2> data(4);
    const int order[4] = {0, 1, 3, 2};  // lexicographic
    for (int i = 0; i < 4; ++i) data.vertices[i] = unsigned(cell.corners[std::size_t(order[i])]);
    cells.push_back(data);
  }
  dealii::SubCellData sub;
  for (const auto& edge : body.edges) {
    dealii::CellData<1> data(2);
    data.vertices = {unsigned(edge.ends[0]), unsigned(edge.ends[1])};
    data.boundary_id = dealii::types::boundary_id(edge.boundary_id);
    data.manifold_id = is_fillet(body.tori, edge.boundary_id) ? dealii::types::manifold_id(edge.boundary_id)
                                                              : dealii::numbers::flat_manifold_id;
    sub.boundary_lines.push_back(data);
  }
  dealii::GridTools::consistently_order_cells(cells);
  mesh.create_triangulation(vertices, cells, sub);
  for (const auto& torus : body.tori)
    mesh.set_manifold(dealii::types::manifold_id(torus.boundary_id),
                      dealii::SphericalManifold<2>({torus.centre_z_m, torus.centre_radius_m}));
}

void require_all_edges(const MeridianBody& body, const dealii::Triangulation<2>& mesh) {
  std::size_t n_edges = 0;
  for (const auto& cell : mesh.active_cell_iterators())
    for (unsigned f = 0; f < 4; ++f)
      if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() != 0) ++n_edges;
  if (n_edges != body.edges.size())
    throw std::invalid_argument("section: " + std::to_string(body.edges.size()) + " surface edges, but " +
                                std::to_string(n_edges) + " sides of cells lie on them");
}

double longest_edge_m(const Cell& cell) {
  double longest = 0;
  for (unsigned f = 0; f < 4; ++f)
    longest = std::max(longest, cell->face(f)->vertex(0).distance(cell->face(f)->vertex(1)));
  return longest;
}

/// From a point to the box around the cell's vertices.
double distance_m(const Cell& cell, const FineCircle& circle) {
  double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double high[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (unsigned v = 0; v < 4; ++v)
    for (unsigned d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], cell->vertex(v)[d]);
      high[d] = std::max(high[d], cell->vertex(v)[d]);
    }
  const double at[2] = {circle.z_m, circle.r_m};
  double beside[2];
  for (int d = 0; d < 2; ++d) beside[d] = std::max({0.0, low[d] - at[d], at[d] - high[d]});
  return std::hypot(beside[0], beside[1]);
}

bool is_too_long(const Cell& cell, const MeridianBody& body) {
  const double longest = longest_edge_m(cell);
  return std::any_of(body.fine_circles.begin(), body.fine_circles.end(), [&](const FineCircle& circle) {
    return longest > circle.size_m + body.fine_growth * distance_m(cell, circle);
  });
}

}  // namespace

void make_meridian_mesh(const MeridianBody& body, dealii::Triangulation<2>& mesh) {
  create(body, mesh);
  require_all_edges(body, mesh);
  for (int i = 0; i < most_cuts; ++i) {
    bool any = false;
    for (const auto& cell : mesh.active_cell_iterators())
      if (is_too_long(cell, body)) {
        cell->set_refine_flag();
        any = true;
      }
    if (!any) break;
    mesh.execute_coarsening_and_refinement();
  }
  if (body.n_cuts > 0) mesh.refine_global(unsigned(body.n_cuts));
}

}  // namespace fem
