// A manufactured solution on a curved body: a smooth displacement, its body force integrated here, held at
// the whole surface of a ring with an eccentric outside. Hexahedra of degree 1, 2, 3 against the orders p + 1
// of displacement and p of stress.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "fem/equations/loads/clamps.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/field_errors.h"

namespace {

using verification::Point;

constexpr fem::Material material{1, 0.3, 1};

/// Half a ring: radii 1 and 2, the outside shifted by 0.3 across its axis; n cells in each direction, 2 n
/// around.
fem::Body eccentric_ring(int degree, int n) {
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  chart.shift_x_m = 0.3;
  chart.inner_radius_m = 1;
  chart.outer_radius_m = 2;
  verification::Block block;
  block.cells = {n, 2 * n, n};
  block.map = [chart](const Point& c) {
    const double r = 1 + c[0], angle = verification::pi * c[1];
    return Point(r * std::cos(angle) + c[0] * chart.shift_x_m, r * std::sin(angle), 1.5 * c[2]);
  };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.degree = degree;
  body.material = material;
  body.cylinders = {chart};
  return body;
}

// u = (sin x cos y, sin y cos z, sin z cos x): each component has the Laplacian -2 u.
Eigen::Vector3d displacement(const Point& p) {
  const double x = p[0], y = p[1], z = p[2];
  return {std::sin(x) * std::cos(y), std::sin(y) * std::cos(z), std::sin(z) * std::cos(x)};
}

Eigen::Matrix<double, 6, 1> stress(const Point& p) {
  const double x = p[0], y = p[1], z = p[2];
  const auto elastic = fem::lame(material);
  const double xx = std::cos(x) * std::cos(y), yy = std::cos(y) * std::cos(z), zz = std::cos(z) * std::cos(x);
  Eigen::Matrix<double, 6, 1> s;
  s << xx, yy, zz, -std::sin(x) * std::sin(y) / 2, -std::sin(y) * std::sin(z) / 2,
      -std::sin(z) * std::sin(x) / 2;
  s *= 2 * elastic.mu_Pa;
  s.head<3>().array() += elastic.lambda_Pa * (xx + yy + zz);
  return s;
}

/// -(lambda + mu) grad div u - mu Laplacian u.
Eigen::Vector3d body_force(const Point& p) {
  const double x = p[0], y = p[1], z = p[2];
  const auto elastic = fem::lame(material);
  const Eigen::Vector3d grad_div(-std::sin(x) * (std::cos(y) + std::cos(z)),
                                 -std::sin(y) * (std::cos(x) + std::cos(z)),
                                 -std::sin(z) * (std::cos(y) + std::cos(x)));
  return 2 * elastic.mu_Pa * displacement(p) - (elastic.lambda_Pa + elastic.mu_Pa) * grad_div;
}

Eigen::MatrixXd load(const fem::Grid& grid) {
  const auto at = fem::gauss_in_cell(grid.shape(), grid.degree + 2);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * grid.n_nodes, 1);
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
    for (int q = 0; q < at.n_points; ++q) {
      const double volume = fem::jacobian(grid, cell, at, q).determinant() * at.weight[q];
      const Eigen::Vector3d b = volume * body_force(fem::position(grid, cell, at, q));
      for (int i = 0; i < at.n_shapes; ++i)
        force.block<3, 1>(3 * grid.nodes_of(cell)[i], 0) += at.value[std::size_t(q) * at.n_shapes + i] * b;
    }
  return force;
}

/// K u = f with the exact displacement at the surface: u = u_surface + what the held body does under the
/// rest.
fem::RowMajor solve(const fem::Grid& grid) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  auto matrix = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(material), matrix);
  std::vector<fem::Clamp> surface;
  for (int side = verification::begin_1; side <= verification::end_3; ++side) {
    surface.emplace_back();
    surface.back().boundary_id = side;
  }
  const auto held = fem::clamped_unknowns(grid, surface);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3 * grid.n_nodes, 1);
  for (const auto i : held) u(i, 0) = displacement(Point(grid.position(i / 3)))[i % 3];
  Eigen::MatrixXd rest = load(grid) - fem::multiply(matrix, u);
  for (const auto i : held) rest(i, 0) = 0;
  fem::clamp(held, matrix);
  fem::CholmodFactor factor(graph, fem::order_nodes(graph));
  factor.factorise(matrix);
  u += factor.solve(rest);
  return Eigen::Map<const fem::RowMajor>(u.data(), grid.n_nodes, 3);
}

class CurvedBody : public testing::TestWithParam<int> {};
TEST_P(CurvedBody, DisplacementPPlus1AndStressP) {
  const int degree = GetParam(), n = degree == 1 ? 6 : degree == 2 ? 3 : 2;
  const auto errors = [&](int cells, verification::Solution& solution) {
    const auto start = std::chrono::steady_clock::now();
    const auto grid = fem::make_grid(eccentric_ring(degree, cells));
    solution.n_dofs = 3 * grid.n_nodes;
    const auto u = solve(grid);
    solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return verification::field_errors(grid, material, {displacement, stress}, u);
  };
  verification::Solution coarse, fine;
  const auto first = errors(n, coarse), second = errors(2 * n, fine);
  verification::expect_orders("curved", degree, first, second, fine);
}
INSTANTIATE_TEST_SUITE_P(Q, CurvedBody, testing::Values(1, 2, 3));

}  // namespace
