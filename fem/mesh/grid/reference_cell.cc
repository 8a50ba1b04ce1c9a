#include "fem/mesh/grid/reference_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_tools.h>

#include <memory>
#include <numeric>

namespace fem {

namespace {

/// deal.II's element, and its number of each of our shape functions.
template <int dim>
struct Element {
  std::unique_ptr<const dealii::FiniteElement<dim>> functions;
  std::vector<unsigned> number;
};

/// Edges of FE_SimplexP come in the order of grid.h.
template <int dim>
Element<dim> quadratic_simplex() {
  Element<dim> element{std::make_unique<dealii::FE_SimplexP<dim>>(2), {}};
  element.number.resize(element.functions->n_dofs_per_cell());
  std::iota(element.number.begin(), element.number.end(), 0U);
  return element;
}

template <int dim>
Element<dim> tensor_product(unsigned degree) {
  return {std::make_unique<dealii::FE_Q<dim>>(degree),
          dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree)};
}

/// Cells and faces of tetrahedra and of degrees 1 to 3, made once.
template <int dim>
const Element<dim>& element_of(CellShape shape) {
  static const std::array<Element<dim>, 4> elements{quadratic_simplex<dim>(), tensor_product<dim>(1),
                                                    tensor_product<dim>(2), tensor_product<dim>(3)};
  return elements.at(shape.is_tetrahedron() ? 0 : std::size_t(shape.degree));
}

template <int dim>
Tabulation tabulate(CellShape shape, const std::vector<dealii::Point<dim>>& points,
                    const std::vector<double>& weights) {
  const auto& [element, number] = element_of<dim>(shape);
  Tabulation t;
  t.n_points = static_cast<int>(points.size());
  t.n_shapes = static_cast<int>(number.size());
  t.weight = weights;
  for (const auto& p : points) {
    std::array<double, 3> at{};
    for (int d = 0; d < dim; ++d) at[d] = p[d];
    t.point.push_back(at);
    for (const auto i : number) {
      t.value.push_back(element->shape_value(i, p));
      const auto gradient = element->shape_grad(i, p);
      std::array<double, 3> g{};
      for (int d = 0; d < dim; ++d) g[d] = gradient[d];
      t.gradient.push_back(g);
    }
  }
  return t;
}

template <int dim>
Tabulation tabulate(CellShape shape, const dealii::Quadrature<dim>& rule) {
  return tabulate<dim>(shape, rule.get_points(), rule.get_weights());
}

template <int dim>
std::vector<dealii::Point<dim>> to_dealii(const ReferencePoints& points) {
  std::vector<dealii::Point<dim>> result(points.size());
  for (std::size_t q = 0; q < points.size(); ++q)
    for (int d = 0; d < dim; ++d) result[q][d] = points[q][d];
  return result;
}

Tabulation at_nodes(CellShape shape) {
  const auto& [element, number] = element_of<3>(shape);
  std::vector<dealii::Point<3>> points;
  for (const auto i : number) points.push_back(element->get_unit_support_points()[i]);
  return tabulate<3>(shape, points, {});
}

}  // namespace

Tabulation gauss_in_cell(CellShape shape, int n) {
  if (shape.is_tetrahedron()) return tabulate<3>(shape, dealii::QWitherdenVincentSimplex<3>(n));
  return tabulate<3>(shape, dealii::QGauss<3>(n));
}

Tabulation gauss_on_face(CellShape shape, int n) {
  if (shape.is_tetrahedron()) return tabulate<2>(shape, dealii::QWitherdenVincentSimplex<2>(n));
  return tabulate<2>(shape, dealii::QGauss<2>(n));
}

Tabulation moment_points_in_cell(CellShape shape) {
  return gauss_in_cell(shape, (5 * shape.degree + 1) / 2);
}

Tabulation stress_points_in_cell(CellShape shape) {
  if (shape.is_tetrahedron()) return tabulate<3>(shape, dealii::QGaussSimplex<3>(2));
  return gauss_in_cell(shape, shape.degree);
}

Tabulation stress_points_on_face(CellShape shape) {
  if (shape.is_tetrahedron()) return tabulate<2>(shape, dealii::QGaussSimplex<2>(2));
  return gauss_on_face(shape, shape.degree);
}

const Tabulation& nodes_in_cell(CellShape shape) {
  static const std::array<Tabulation, 4> tables{
      at_nodes({CellKind::tetrahedra, 2}), at_nodes({CellKind::hexahedra, 1}),
      at_nodes({CellKind::hexahedra, 2}), at_nodes({CellKind::hexahedra, 3})};
  return tables.at(shape.is_tetrahedron() ? 0 : std::size_t(shape.degree));
}

Tabulation tabulate_in_cell(CellShape shape, const ReferencePoints& points,
                            const std::vector<double>& weights) {
  return tabulate<3>(shape, to_dealii<3>(points), weights);
}

Tabulation tabulate_on_face(CellShape shape, const ReferencePoints& points) {
  return tabulate<2>(shape, to_dealii<2>(points), {});
}

std::vector<double> corner_hats(CellShape shape, const std::array<double, 3>& point) {
  if (shape.is_tetrahedron()) return {1 - point[0] - point[1] - point[2], point[0], point[1], point[2]};
  std::vector<double> hats(8);
  for (int c = 0; c < 8; ++c) {
    hats[c] = 1;
    for (int d = 0; d < 3; ++d) hats[c] *= ((c >> d) & 1) ? point[d] : 1 - point[d];
  }
  return hats;
}

}  // namespace fem
