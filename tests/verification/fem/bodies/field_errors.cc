#include "tests/verification/fem/bodies/field_errors.h"

#include <cmath>

#include "fem/mesh/triangulation/body_grid.h"

namespace verification {

Field axisymmetric(const std::function<double(double)>& radial_m,
                   const std::function<std::array<double, 3>(double)>& stress_Pa) {
  return {[=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            const double r = std::hypot(x[0], x[1]);
            return radial_m(r) / r * Eigen::Vector3d(x[0], x[1], 0);
          },
          [=](const Eigen::Vector3d& x) {
            const double r = std::hypot(x[0], x[1]), c = x[0] / r, s = x[1] / r;
            const auto [radial, around, along] = stress_Pa(r);
            Eigen::Matrix<double, 6, 1> t;
            t << radial * c * c + around * s * s, radial * s * s + around * c * c, along,
                (radial - around) * c * s, 0, 0;
            return t;
          }};
}

FieldErrors field_errors(const fem::Grid& grid, const fem::Material& material, const Field& exact,
                         const fem::ConstBlock& displacement_m) {
  const auto at = fem::gauss_in_cell(grid.shape(), grid.degree + 2);
  const auto elastic = fem::lame(material);
  fem::CellStress cell_stress(grid, at, elastic, displacement_m);
  fem::RowMajor stress(at.n_points, 6);
  double displacement_error = 0, displacement_norm = 0, stress_error = 0, stress_norm = 0;
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
    cell_stress(cell, stress);
    for (int q = 0; q < at.n_points; ++q) {
      const double volume = fem::jacobian(grid, cell, at, q).determinant() * at.weight[q];
      const Eigen::Vector3d x = fem::position(grid, cell, at, q);
      Eigen::Vector3d u = Eigen::Vector3d::Zero();
      for (int i = 0; i < at.n_shapes; ++i)
        u += at.value[std::size_t(q) * at.n_shapes + i] *
             displacement_m.row(grid.nodes_of(cell)[i]).transpose();
      const Eigen::Vector3d u_exact = exact.displacement_m(x);
      const Eigen::Matrix<double, 6, 1> s_exact = exact.stress_Pa(x);
      displacement_error += volume * (u - u_exact).squaredNorm();
      displacement_norm += volume * u_exact.squaredNorm();
      stress_error += volume * (stress.row(q).transpose() - s_exact).squaredNorm();
      stress_norm += volume * s_exact.squaredNorm();
    }
  }
  return {std::sqrt(displacement_error / displacement_norm), std::sqrt(stress_error / stress_norm)};
}

void expect_orders(const std::string& name, const Field& exact, const fem::Body& coarse,
                   const fem::Body& fine, const LoadCase& loads) {
  const auto errors = [&](const fem::Body& body, const Solution& solution) {
    const fem::RowMajor u = solution.displacement_m.transpose();
    return field_errors(fem::make_grid(body), body.material, exact, u);
  };
  const auto first = solve(coarse, loads, fem::Recovery::average);
  const auto second = solve(fine, loads, fem::Recovery::average);
  expect_orders(name, fine.degree, errors(coarse, first), errors(fine, second), second);
}

void expect_orders(const std::string& name, int degree, const FieldErrors& coarse, const FieldErrors& fine,
                   const Solution& finest) {
  const std::string q = ", Q" + std::to_string(degree);
  // Two meshes apart by a factor of two: a twentieth either way is what is left of higher terms. A curved
  // boundary followed too coarsely, or a load off its place, costs half an order or more.
  check_order(
      {name, "order of displacement" + q, degree + 1.0, std::log2(coarse.displacement / fine.displacement)},
      finest, 0.2, 0.5);
  check_order({name, "order of stress" + q, double(degree), std::log2(coarse.stress / fine.stress)}, finest,
              0.2, 0.5);
}

}  // namespace verification
