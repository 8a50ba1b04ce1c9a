// The recovery-based estimate beside the true error in the norm of energy, where the solution is known:
// cylinders in plane strain under pressure and spinning, on even and distorted meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/mesh/triangulation/body_grid.h"
#include "tests/verification/fem/bodies/plane_strain_cylinder.h"

namespace {

using Cylinder = verification::PlaneStrainCylinder;
using verification::Field;
constexpr auto hexahedra = fem::CellKind::hexahedra, tetrahedra = fem::CellKind::tetrahedra;
constexpr double a = Cylinder::inner_m, b = Cylinder::outer_m, p_Pa = Cylinder::pressure_Pa;

struct Case {
  const char* name;
  Cylinder cylinder;
  std::vector<int> meshes;  ///< cells in each direction of the plane
};

/// |exact - cells' stress| / |exact|, by s : strain with Hooke's law as e = ((1 + nu) s - nu tr s I) / E.
double true_error(const fem::Body& body, const Field& exact, const verification::Solution& solution) {
  const auto grid = fem::make_grid(body);
  const auto at = fem::gauss_in_cell(grid.shape(), grid.degree + 2);
  const fem::RowMajor u = solution.displacement_m.transpose();
  fem::CellStress cell_stress(grid, at, fem::lame(body.material), u);
  fem::RowMajor stress(at.n_points, 6);
  const double nu = body.material.poisson_ratio;
  const auto energy = [&](const Eigen::Matrix<double, 6, 1>& s) {
    return (1 + nu) * (s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm()) -
           nu * std::pow(s.head<3>().sum(), 2);
  };
  double error = 0, norm = 0;
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
    cell_stress(cell, stress);
    for (int q = 0; q < at.n_points; ++q) {
      const double volume = fem::jacobian(grid, cell, at, q).determinant() * at.weight[q];
      const Eigen::Matrix<double, 6, 1> there = exact.stress_Pa(fem::position(grid, cell, at, q));
      error += volume * energy(stress.row(q).transpose() - there);
      norm += volume * energy(there);
    }
  }
  return std::sqrt(error / norm);
}

class EnergyError : public testing::TestWithParam<Case> {};

// Effectivity, estimate over truth: between 0.7 and 3.
TEST_P(EnergyError, EstimateIsOfTheSizeOfTheTruth) {
  const auto& [name, c, meshes] = GetParam();
  for (const int n : meshes) {
    const auto model = c.body(n);
    const auto s = verification::solve(model, c.loads());
    const double truth = true_error(model, c.exact(), s), effectivity = s.energy.relative() / truth;
    EXPECT_GT(effectivity, 0.7) << n << " cells: " << s.energy.relative() << " for " << truth;
    EXPECT_LT(effectivity, 3) << n << " cells: " << s.energy.relative() << " for " << truth;
    RecordProperty("effectivity_" + std::to_string(n), std::to_string(effectivity));
    RecordProperty("truth_" + std::to_string(n), std::to_string(truth));
    // p_Pa of pressure does twice the strain energy: |s|^2 = p times the volume swept.
    if (!c.spins) {
      const double swept =
          verification::pi / 2 * a * Cylinder::height_m * c.exact().displacement_m({a, 0, 0})[0];
      EXPECT_NEAR(s.energy.solution_sqrtJ, std::sqrt(p_Pa * swept), (0.01 + truth) * std::sqrt(p_Pa * swept));
    }
  }
}

// Channels whose fields are the same field: their sum has its error, whatever the factors.
TEST(EnergyErrorOfSums, IsThatOfTheSum) {
  const Cylinder c{false, hexahedra, 2, 0.1, 0.3};
  const auto model = c.body(3);
  const auto pressure = c.loads().front().first;
  const auto whole = verification::solve(model, {{pressure, p_Pa}}).energy;
  const auto parts = verification::solve(model, {{pressure, 3 * p_Pa}, {pressure, -2 * p_Pa}}).energy;
  // Squares of 3 and 2 cancel to 1: a few digits of rounding are lost.
  EXPECT_NEAR(parts.solution_sqrtJ, whole.solution_sqrtJ, 1e-10 * whole.solution_sqrtJ);
  EXPECT_NEAR(parts.error_sqrtJ, whole.error_sqrtJ, 1e-8 * whole.error_sqrtJ);
}

// The cells' parts make up the whole, and most of it lies where stress is steepest: at the bore.
TEST(EnergyErrorOfCells, SumsToThatOfTheBody) {
  const Cylinder c{false, hexahedra, 2, 0, 0.3};
  const auto r = fem::Model(c.body(6)).unit_responses({{"pressure", c.loads().front().first}}, {});
  double sum = 0, inner = 0;
  for (std::size_t cell = 0; cell < r.nodes.n_cells(); ++cell) {
    const double part = r.energy_error.of_cells[cell];
    double radius = 0;
    for (const auto node : r.nodes.cell(cell))
      radius += std::hypot(r.nodes.xyz_m[3 * node], r.nodes.xyz_m[3 * node + 1]) / 27;
    sum += part;
    if (radius < std::sqrt(a * b)) inner += part;
  }
  EXPECT_NEAR(sum, r.energy_error.error.front(), 1e-12 * sum);
  EXPECT_GT(inner, 0.6 * sum);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, EnergyError,
    testing::Values(Case{"pressure_Q2", {false, hexahedra, 2, 0, 0.3}, {2, 4, 8}},
                    Case{"pressure_Q2_distorted", {false, hexahedra, 2, 0.1, 0.3}, {4, 8, 16}},
                    Case{"pressure_Q3_distorted", {false, hexahedra, 3, 0.1, 0.3}, {2, 4, 8}},
                    Case{"pressure_Q2_nu_4999", {false, hexahedra, 2, 0.1, 0.4999}, {4, 8, 16}},
                    Case{"spin_Q2", {true, hexahedra, 2, 0, 0.3}, {2, 4, 8}},
                    Case{"spin_Q2_distorted", {true, hexahedra, 2, 0.1, 0.3}, {3, 6, 12}},
                    Case{"spin_Q1", {true, hexahedra, 1, 0, 0.3}, {4, 8, 16}},
                    Case{"pressure_P2", {false, tetrahedra, 2, 0.1, 0.3}, {2, 4, 8}},
                    Case{"spin_P2", {true, tetrahedra, 2, 0, 0.3}, {2, 4, 8}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
