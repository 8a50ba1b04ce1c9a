#include "fem/reference_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

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

}  // namespace

Tabulation gauss_in_cell(int degree, int n) {
  const dealii::QGauss<3> quadrature(n);
  return tabulate<3>(degree, quadrature.get_points(), quadrature.get_weights());
}

Tabulation gauss_on_face(int degree, int n) {
  const dealii::QGauss<2> quadrature(n);
  return tabulate<2>(degree, quadrature.get_points(), quadrature.get_weights());
}

Tabulation nodes_in_cell(int degree) {
  const dealii::FE_Q<3> element(degree);
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(degree);
  std::vector<dealii::Point<3>> points;
  for (const auto i : hierarchic) points.push_back(element.get_unit_support_points()[i]);
  return tabulate<3>(degree, points, {});
}

std::array<double, 8> corner_hats(const std::array<double, 3>& point) {
  std::array<double, 8> hats{};
  for (int c = 0; c < 8; ++c) {
    hats[c] = 1;
    for (int d = 0; d < 3; ++d) hats[c] *= ((c >> d) & 1) ? point[d] : 1 - point[d];
  }
  return hats;
}

}  // namespace fem
