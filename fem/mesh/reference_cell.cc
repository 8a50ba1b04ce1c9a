#include "fem/mesh/reference_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include "fem/common/simplex.h"

namespace fem {

namespace {

template <int dim>
Tabulation tabulate(int degree, const std::vector<dealii::Point<dim>>& points,
                    const std::vector<double>& weights) {
  const dealii::FE_Q<dim> element(degree);
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
  Tabulation t;
  t.n_points = static_cast<int>(points.size());
  t.n_shapes = static_cast<int>(element.n_dofs_per_cell());
  t.weight = weights;
  for (const auto& p : points) {
    std::array<double, 3> at{};
    for (int d = 0; d < dim; ++d) at[d] = p[d];
    t.point.push_back(at);
    for (int i = 0; i < t.n_shapes; ++i) {
      t.value.push_back(element.shape_value(hierarchic[i], p));
      const auto gradient = element.shape_grad(hierarchic[i], p);
      std::array<double, 3> g{};
      for (int d = 0; d < dim; ++d) g[d] = gradient[d];
      t.gradient.push_back(g);
    }
  }
  return t;
}

Tabulation tabulate_simplex(std::vector<ShapeAt> (*shapes)(const std::array<double, 3>&),
                            const std::vector<std::array<double, 3>>& points,
                            const std::vector<double>& weights) {
  Tabulation t;
  t.n_points = static_cast<int>(points.size());
  t.weight = weights;
  t.point = points;
  for (const auto& p : points) {
    const auto at_point = shapes(p);
    t.n_shapes = static_cast<int>(at_point.size());
    for (const auto& s : at_point) {
      t.value.push_back(s.value);
      t.gradient.push_back(s.gradient);
    }
  }
  return t;
}

template <int dim>
Tabulation tabulate_simplex(const dealii::Quadrature<dim>& rule) {
  std::vector<std::array<double, 3>> points;
  for (const auto& p : rule.get_points()) {
    std::array<double, 3> at{};
    for (int d = 0; d < dim; ++d) at[d] = p[d];
    points.push_back(at);
  }
  return tabulate_simplex(dim == 3 ? quadratic_tetrahedron : quadratic_triangle, points, rule.get_weights());
}

}  // namespace

Tabulation gauss_in_cell(CellShape shape, int n) {
  if (shape.is_tetrahedron()) return tabulate_simplex<3>(dealii::QWitherdenVincentSimplex<3>(n));
  const dealii::QGauss<3> quadrature(n);
  return tabulate<3>(shape.degree, quadrature.get_points(), quadrature.get_weights());
}

Tabulation gauss_on_face(CellShape shape, int n) {
  if (shape.is_tetrahedron()) return tabulate_simplex<2>(dealii::QWitherdenVincentSimplex<2>(n));
  const dealii::QGauss<2> quadrature(n);
  return tabulate<2>(shape.degree, quadrature.get_points(), quadrature.get_weights());
}

Tabulation moment_points_in_cell(CellShape shape) {
  return gauss_in_cell(shape, (5 * shape.degree + 1) / 2);
}

Tabulation stress_points_in_cell(CellShape shape) {
  if (shape.is_tetrahedron()) return tabulate_simplex<3>(dealii::QGaussSimplex<3>(2));
  return gauss_in_cell(shape, shape.degree);
}

Tabulation stress_points_on_face(CellShape shape) {
  if (shape.is_tetrahedron()) return tabulate_simplex<2>(dealii::QGaussSimplex<2>(2));
  return gauss_on_face(shape, shape.degree);
}

Tabulation nodes_in_cell(CellShape shape) {
  if (shape.is_tetrahedron()) return tabulate_simplex(quadratic_tetrahedron, tetrahedron_nodes(), {});
  const dealii::FE_Q<3> element(shape.degree);
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(shape.degree);
  std::vector<dealii::Point<3>> points;
  for (const auto i : hierarchic) points.push_back(element.get_unit_support_points()[i]);
  return tabulate<3>(shape.degree, points, {});
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
