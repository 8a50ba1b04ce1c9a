#include "fem/models/axisymmetric/meridian_grid.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "fem/base/values/constants.h"
#include "fem/base/values/errors.h"
#include "fem/models/axisymmetric/meridian_mesh.h"
#include "fem/models/axisymmetric/meridian_numbering.h"

namespace fem {
namespace {

using DofCell = dealii::DoFHandler<2>::active_cell_iterator;
using Cell = dealii::Triangulation<2>::cell_iterator;
using Line = dealii::Triangulation<2>::face_iterator;
using Ends = std::pair<unsigned, unsigned>;

/// Sides of a quadrilateral counter-clockwise: where each begins and ends, and its number.
struct Side {
  unsigned begin, end, face;
};
constexpr std::array<Side, 4> sides{{{0, 1, 2}, {1, 3, 1}, {3, 2, 3}, {2, 0, 0}}};

/// Corners, middles of the edges in the order of deal.II's faces, and centre of the unit square.
dealii::Quadrature<2> result_points() {
  return dealii::Quadrature<2>(std::vector<dealii::Point<2>>{
      {0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 0.5}, {1, 0.5}, {0.5, 0}, {0.5, 1}, {0.5, 0.5}});
}
constexpr unsigned first_middle = 4, centre_point = 8;

/// Copies what a deal.II evaluator knows at its point q.
template <typename Values>
SectionPoint point_of(const Values& values, const MeridianNumbering::OfCell& numbers, int cell, unsigned q) {
  SectionPoint p;
  p.cell = cell;
  p.z_m = values.quadrature_point(q)[0];
  p.r_m = values.quadrature_point(q)[1];
  const auto n = Eigen::Index(numbers.nodes.size());
  p.value.setZero(n);
  p.by_z.setZero(n);
  p.by_r.setZero(n);
  for (unsigned i = 0; i < values.dofs_per_cell; ++i)
    for (const auto& [node, factor] : numbers.parts[i]) {
      p.value[node] += factor * values.shape_value(i, q);
      p.by_z[node] += factor * values.shape_grad(i, q)[0];
      p.by_r[node] += factor * values.shape_grad(i, q)[1];
    }
  return p;
}

class GridBuilder {
public:
  GridBuilder(const MeridianBody& body, const std::vector<SectionPlane>& planes)
      : planes_(planes),
        mesh_(dealii::Triangulation<2>::limit_level_difference_at_vertices),
        mapping_(unsigned(body.degree)),
        element_(unsigned(body.degree)) {
    make_meridian_mesh(body, mesh_);
    dofs_.reinit(mesh_);
    dofs_.distribute_dofs(element_);
  }

  MeridianGrid build() {
    const MeridianNumbering numbering(dofs_);
    place_nodes(numbering);
    for (const auto& cell : mesh_.cell_iterators_on_level(0)) show(cell);
    for (const auto& cell : shown_) add_polygon(cell);
    grid_.planes.resize(planes_.size());
    seen_m_.assign(planes_.size(), {0, 0});
    integrate(numbering);
    check_planes();
    return std::move(grid_);
  }

private:
  void place_nodes(const MeridianNumbering& numbering) {
    std::vector<dealii::Point<2>> nodes(dofs_.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(mapping_, dofs_, nodes);
    double largest_r = 0;
    for (const auto& p : nodes) largest_r = std::max(largest_r, p[1]);
    axis_r_m_ = 1e-9 * largest_r;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (numbering[i] < 0) continue;
      grid_.on_axis.push_back(nodes[i][1] < axis_r_m_);
      grid_.z_m.push_back(nodes[i][0]);
      grid_.r_m.push_back(grid_.on_axis.back() ? 0 : nodes[i][1]);
    }
  }

  int new_point() {
    grid_.results.emplace_back();
    return int(grid_.results.size()) - 1;
  }
  int point_at(unsigned vertex) {
    const auto [known, is_new] = vertex_.try_emplace(vertex, 0);
    if (is_new) known->second = new_point();
    return known->second;
  }

  static bool is_on_surface(const Line& line) { return line->at_boundary() && line->boundary_id() != 0; }
  static bool is_at_surface(const Cell& cell) {
    return std::any_of(sides.begin(), sides.end(),
                       [&](const Side& side) { return is_on_surface(cell->face(side.face)); });
  }

  /// At the surface cells are shown as they are cut, down to the last ones; others as they are beside these.
  void show(const Cell& cell) {
    if (cell->has_children() && is_at_surface(cell)) {
      for (unsigned c = 0; c < cell->n_children(); ++c) show(cell->child(c));
      return;
    }
    polygon_of_[{cell->level(), cell->index()}] = shown_.size();
    shown_.push_back(cell);
    for (unsigned v = 0; v < 4; ++v) point_at(cell->vertex_index(v));
  }

  void add_edge(const Line& line, unsigned begin, unsigned end, ResultPolygon& polygon) {
    SurfaceEdge edge;
    edge.boundary_id = int(line->boundary_id());
    edge.result_points = {point_at(begin), new_point(), point_at(end)};
    polygon.points.insert(polygon.points.end(), {edge.result_points[0], edge.result_points[1]});
    edge_of_[std::minmax(begin, end)] = grid_.edges.size();
    grid_.edges.push_back(edge);
  }

  /// The points on a line inside, from `begin` on and without `end`: those of smaller cells on its other side
  /// as well.
  void add_line(const Line& line, unsigned begin, unsigned end, ResultPolygon& polygon) {
    if (line->has_children()) {
      const unsigned middle = line->child(0)->vertex_index(1);
      if (vertex_.count(middle) != 0) {
        const unsigned first = line->vertex_index(0) == begin ? 0 : 1;
        add_line(line->child(first), begin, middle, polygon);
        add_line(line->child(1 - first), middle, end, polygon);
        return;
      }
    }
    polygon.points.push_back(point_at(begin));
  }

  void add_polygon(const Cell& cell) {
    ResultPolygon polygon;
    for (const auto& side : sides) {
      const auto line = cell->face(side.face);
      const unsigned begin = cell->vertex_index(side.begin), end = cell->vertex_index(side.end);
      if (is_on_surface(line))
        add_edge(line, begin, end, polygon);
      else
        add_line(line, begin, end, polygon);
    }
    if (polygon.points.size() > 4)
      polygon.centre = cell->has_children() ? point_at(cell->child(0)->vertex_index(3)) : new_point();
    grid_.polygons.push_back(polygon);
  }

  /// The edge that the face of a cell is, or none.
  SurfaceEdge* edge_of(const DofCell& cell, unsigned face) {
    const auto line = cell->face(face);
    const auto found = edge_of_.find(std::minmax(line->vertex_index(0), line->vertex_index(1)));
    return found == edge_of_.end() ? nullptr : &grid_.edges[found->second];
  }

  void sample(const DofCell& cell, const MeridianNumbering::OfCell& numbers, dealii::FEValues<2>& values) {
    std::array<int, 9> points;
    points.fill(-1);
    for (unsigned v = 0; v < 4; ++v)
      if (const auto known = vertex_.find(cell->vertex_index(v)); known != vertex_.end())
        points[v] = known->second;
    for (unsigned f = 0; f < 4; ++f)
      if (const auto* edge = edge_of(cell, f)) points[first_middle + f] = edge->result_points[1];
    if (const auto shown = polygon_of_.find({cell->level(), cell->index()}); shown != polygon_of_.end())
      points[centre_point] = grid_.polygons[shown->second].centre;
    if (std::all_of(points.begin(), points.end(), [](int p) { return p < 0; })) return;
    values.reinit(cell);
    for (unsigned q = 0; q < points.size(); ++q) {
      if (points[q] < 0) continue;
      auto& point = grid_.results[std::size_t(points[q])];
      point.samples.push_back(point_of(values, numbers, int(cell->active_cell_index()), q));
      auto& r_m = point.samples.back().r_m;
      if (r_m < axis_r_m_) r_m = 0;
      point.z_m = point.samples.back().z_m;
      point.r_m = r_m;
    }
  }

  void integrate(const MeridianNumbering& numbering) {
    const auto degree = element_.degree;
    // One point more than the stiffness of straight cells needs: r and 1/r are weights.
    const auto what = dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                      dealii::update_JxW_values;
    dealii::FEValues<2> inside(mapping_, element_, dealii::QGauss<2>(degree + 1), what);
    dealii::FEFaceValues<2> along(mapping_, element_, dealii::QGauss<1>(degree + 3),
                                  what | dealii::update_normal_vectors);
    dealii::FEValues<2> at_results(
        mapping_, element_, result_points(),
        dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points);
    for (const auto& cell : dofs_.active_cell_iterators()) {
      const int index = int(cell->active_cell_index());
      const auto numbers = numbering.of(cell);
      grid_.cell_nodes.push_back(numbers.nodes);
      inside.reinit(cell);
      integrate_cell(cell, numbers, inside);
      for (unsigned f = 0; f < 4; ++f) {
        auto* edge = edge_of(cell, f);
        const int plane = plane_of(cell, f);
        if (!edge && plane < 0) continue;
        along.reinit(cell, f);
        for (unsigned q = 0; q < along.n_quadrature_points; ++q) {
          SectionPoint p = point_of(along, numbers, index, q);
          p.weight = along.JxW(q);
          p.normal_z = along.normal_vector(q)[0];
          p.normal_r = along.normal_vector(q)[1];
          if (plane >= 0) add_to_plane(std::size_t(plane), p);
          if (edge) edge->points.push_back(std::move(p));
        }
      }
      sample(cell, numbers, at_results);
    }
  }

  void integrate_cell(const DofCell& cell, const MeridianNumbering::OfCell& numbers,
                      const dealii::FEValues<2>& inside) {
    auto shown = static_cast<Cell>(cell);
    while (polygon_of_.count({shown->level(), shown->index()}) == 0) shown = shown->parent();
    double& volume_m3 = grid_.polygons[polygon_of_.at({shown->level(), shown->index()})].volume_m3;
    grid_.cell_points.emplace_back();
    for (unsigned q = 0; q < inside.n_quadrature_points; ++q) {
      grid_.cell_points.back().push_back(point_of(inside, numbers, int(cell->active_cell_index()), q));
      auto& p = grid_.cell_points.back().back();
      p.weight = inside.JxW(q);
      if (!(p.weight > 0))
        throw MeshUnusable(
            "the section has an inverted cell near z = " + std::to_string(cell->center()[0]) +
            ", r = " + std::to_string(cell->center()[1]) +
            " m: its fillet is too small for the cells beside it; take more cells on its quarter or "
            "another fillet");
      volume_m3 += 2 * pi * p.r_m * p.weight;
    }
  }

  /// The section plane that a side of a cell lies in, or -1.
  int plane_of(const DofCell& cell, unsigned face) const {
    const auto a = cell->face(face)->vertex(0), b = cell->face(face)->vertex(1);
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const auto& plane = planes_[i];
      const double tolerance = plane_tolerance * plane.radius_m;
      if (std::abs(a[0] - plane.z_m) <= tolerance && std::abs(b[0] - plane.z_m) <= tolerance &&
          std::max(a[1], b[1]) <= plane.radius_m + tolerance &&
          std::min(a[1], b[1]) >= plane.inner_radius_m - tolerance)
        return int(i);
    }
    return -1;
  }
  void add_to_plane(std::size_t plane, const SectionPoint& p) {
    seen_m_[plane][p.normal_z > 0] += p.weight;
    grid_.planes[plane].points.push_back(p);
  }

  /// A plane inside the body is seen by cells below and above it, one at an end by the cells of one side.
  void check_planes() {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double wall_m = planes_[i].radius_m - planes_[i].inner_radius_m;
      int n_sides = 0;
      for (const double seen_m : seen_m_[i]) {
        if (seen_m == 0) continue;
        ++n_sides;
        if (std::abs(seen_m - wall_m) > 1e-6 * wall_m) n_sides = -2;
      }
      if (n_sides < 1)
        throw std::invalid_argument("section plane z = " + std::to_string(planes_[i].z_m) + " m, radius " +
                                    std::to_string(planes_[i].radius_m) +
                                    " m: no line of cell edges through the whole wall");
      for (auto& p : grid_.planes[i].points) p.weight /= n_sides;
    }
  }

  static constexpr double plane_tolerance = 1e-6;  // of the radius, as for the solid's sections
  const std::vector<SectionPlane>& planes_;
  dealii::Triangulation<2> mesh_;
  dealii::MappingQ<2> mapping_;
  dealii::FE_Q<2> element_;
  dealii::DoFHandler<2> dofs_;
  MeridianGrid grid_;
  double axis_r_m_ = 0;
  std::vector<Cell> shown_;                                ///< by polygon
  std::map<std::pair<int, int>, std::size_t> polygon_of_;  ///< by a shown cell's level and index
  std::map<unsigned, int> vertex_;
  std::map<Ends, std::size_t> edge_of_;
  std::vector<std::array<double, 2>> seen_m_;  // length of each plane from above and from below
};

}  // namespace

MeridianGrid meridian_grid(const MeridianBody& body, const std::vector<SectionPlane>& planes) {
  if (body.degree < 1 || body.degree > 4)
    throw std::invalid_argument("degree " + std::to_string(body.degree) + " of a section: must be 1 to 4");
  return GridBuilder(body, planes).build();
}

}  // namespace fem
