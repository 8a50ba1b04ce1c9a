#include "fem/meridian_grid.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace fem {
namespace {

using Cell = dealii::DoFHandler<2>::active_cell_iterator;
using Ends = std::pair<unsigned, unsigned>;

/// Arcs get the manifold of their boundary id; all else is straight.
void make_mesh(const MeridianBody& body, dealii::Triangulation<2>& mesh) {
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
    const bool is_arc = std::any_of(body.tori.begin(), body.tori.end(),
                                    [&](const auto& torus) { return torus.boundary_id == edge.boundary_id; });
    data.manifold_id =
        is_arc ? dealii::types::manifold_id(edge.boundary_id) : dealii::numbers::flat_manifold_id;
    sub.boundary_lines.push_back(data);
  }
  dealii::GridTools::consistently_order_cells(cells);
  mesh.create_triangulation(vertices, cells, sub);
  for (const auto& torus : body.tori)
    mesh.set_manifold(dealii::types::manifold_id(torus.boundary_id),
                      dealii::SphericalManifold<2>({torus.centre_z_m, torus.centre_radius_m}));
}

/// Copies what a deal.II evaluator knows at its point q.
template <typename Values>
SectionPoint point_of(const Values& values, int cell, unsigned q) {
  SectionPoint p;
  p.cell = cell;
  p.z_m = values.quadrature_point(q)[0];
  p.r_m = values.quadrature_point(q)[1];
  const unsigned n = values.dofs_per_cell;
  p.value.resize(n);
  p.by_z.resize(n);
  p.by_r.resize(n);
  for (unsigned i = 0; i < n; ++i) {
    p.value[i] = values.shape_value(i, q);
    p.by_z[i] = values.shape_grad(i, q)[0];
    p.by_r[i] = values.shape_grad(i, q)[1];
  }
  return p;
}

/// The corners and the middles of the edges of the unit square, in the order of deal.II's vertices and lines.
dealii::Quadrature<2> corners_and_middles() {
  return dealii::Quadrature<2>(
      std::vector<dealii::Point<2>>{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 0.5}, {1, 0.5}, {0.5, 0}, {0.5, 1}});
}

/// Collects the points of the surface from the cells that touch it.
class SurfaceBuilder {
public:
  SurfaceBuilder(const MeridianBody& body, const dealii::Mapping<2>& mapping,
                 const dealii::FiniteElement<2>& element, MeridianGrid& grid)
      : grid_(grid),
        values_(mapping, element, corners_and_middles(),
                dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points) {
    for (const auto& edge : body.edges) {
      const Ends ends(unsigned(edge.ends[0]), unsigned(edge.ends[1]));
      edge_of_[std::minmax(ends.first, ends.second)] = grid.edges.size();
      SurfaceEdge entry;
      entry.boundary_id = edge.boundary_id;
      entry.surface_points = {vertex_point(ends.first), new_point(), vertex_point(ends.second)};
      grid.edges.push_back(entry);
    }
  }
  /// The edge that the face of a cell is, or none.
  SurfaceEdge* edge_of(const Cell& cell, unsigned face) const {
    const Ends ends = std::minmax(cell->face(face)->vertex_index(0), cell->face(face)->vertex_index(1));
    const auto found = edge_of_.find(ends);
    return found == edge_of_.end() ? nullptr : &grid_.edges[found->second];
  }
  void sample(const Cell& cell) {
    std::vector<int> points(8, -1);
    for (unsigned v = 0; v < 4; ++v)
      if (const auto known = vertex_.find(cell->vertex_index(v)); known != vertex_.end())
        points[v] = known->second;
    for (unsigned f = 0; f < 4; ++f)
      if (const auto* edge = edge_of(cell, f)) points[4 + f] = edge->surface_points[1];
    if (std::all_of(points.begin(), points.end(), [](int p) { return p < 0; })) return;
    values_.reinit(cell);
    for (unsigned q = 0; q < 8; ++q) {
      if (points[q] < 0) continue;
      auto& point = grid_.surface[std::size_t(points[q])];
      point.samples.push_back(point_of(values_, int(cell->active_cell_index()), q));
      point.z_m = point.samples.back().z_m;
      point.r_m = point.samples.back().r_m;
    }
  }

private:
  int new_point() {
    grid_.surface.emplace_back();
    return int(grid_.surface.size()) - 1;
  }
  int vertex_point(unsigned vertex) {
    const auto [known, is_new] = vertex_.try_emplace(vertex, 0);
    if (is_new) known->second = new_point();
    return known->second;
  }
  MeridianGrid& grid_;
  dealii::FEValues<2> values_;
  std::map<unsigned, int> vertex_;
  std::map<Ends, std::size_t> edge_of_;
};

}  // namespace

MeridianGrid meridian_grid(const MeridianBody& body) {
  if (body.degree < 1 || body.degree > 4)
    throw std::invalid_argument("degree " + std::to_string(body.degree) + " of a section: must be 1 to 4");
  dealii::Triangulation<2> mesh;
  make_mesh(body, mesh);
  const auto degree = unsigned(body.degree);
  const dealii::MappingQ<2> mapping(degree);
  const dealii::FE_Q<2> element(degree);
  dealii::DoFHandler<2> dofs(mesh);
  dofs.distribute_dofs(element);
  std::vector<dealii::Point<2>> nodes(dofs.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(mapping, dofs, nodes);

  MeridianGrid grid;
  double largest_r = 0;
  for (const auto& p : nodes) largest_r = std::max(largest_r, p[1]);
  for (const auto& p : nodes) {
    grid.on_axis.push_back(p[1] < 1e-9 * largest_r);
    grid.z_m.push_back(p[0]);
    grid.r_m.push_back(grid.on_axis.back() ? 0 : p[1]);
  }
  SurfaceBuilder surface(body, mapping, element, grid);
  // One point more than the stiffness of straight cells needs: r and 1/r are weights.
  const auto what = dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                    dealii::update_JxW_values;
  dealii::FEValues<2> inside(mapping, element, dealii::QGauss<2>(degree + 1), what);
  dealii::FEFaceValues<2> along(mapping, element, dealii::QGauss<1>(degree + 3),
                                what | dealii::update_normal_vectors);
  std::size_t n_edges = 0;
  for (const auto& cell : dofs.active_cell_iterators()) {
    const int index = int(cell->active_cell_index());
    std::vector<dealii::types::global_dof_index> own(element.n_dofs_per_cell());
    cell->get_dof_indices(own);
    grid.cell_nodes.emplace_back(own.begin(), own.end());
    inside.reinit(cell);
    grid.cell_points.emplace_back();
    for (unsigned q = 0; q < inside.n_quadrature_points; ++q) {
      grid.cell_points.back().push_back(point_of(inside, index, q));
      grid.cell_points.back().back().weight = inside.JxW(q);
      if (!(inside.JxW(q) > 0))
        throw std::invalid_argument("section: the cell at z = " + std::to_string(cell->center()[0]) +
                                    ", r = " + std::to_string(cell->center()[1]) + " m is inverted");
    }
    for (unsigned f = 0; f < 4; ++f) {
      auto* edge = surface.edge_of(cell, f);
      if (!edge) continue;
      ++n_edges;
      along.reinit(cell, f);
      for (unsigned q = 0; q < along.n_quadrature_points; ++q) {
        edge->points.push_back(point_of(along, index, q));
        edge->points.back().weight = along.JxW(q);
        edge->points.back().normal_z = along.normal_vector(q)[0];
        edge->points.back().normal_r = along.normal_vector(q)[1];
      }
    }
    surface.sample(cell);
  }
  if (n_edges != body.edges.size())
    throw std::invalid_argument("section: " + std::to_string(body.edges.size()) + " surface edges, but " +
                                std::to_string(n_edges) + " sides of cells lie on them");
  return grid;
}

}  // namespace fem
