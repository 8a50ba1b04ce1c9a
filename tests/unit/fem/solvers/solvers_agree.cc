#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/model/model.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

std::vector<fem::UnitLoad> three_loads(const fem_tests::ShaftBody& shaft) {
  std::vector<fem::UnitLoad> loads;
  for (const auto c : {Component::fx, Component::fz, Component::torque})
    for (const auto* port : {"end_1", "end_2"}) loads.push_back(fem_tests::resultant(shaft, port, c));
  loads.push_back({"volume.ax", fem::BodyForce{fem::BodyForce::Field::translation_x}});
  loads.push_back({"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}});
  return loads;
}

fem::UnitResponses solve(const fem_tests::ShaftBody& shaft, const fem::SolverChoice& choice) {
  return fem::Model(shaft.body).unit_responses(three_loads(shaft), {}, fem::Recovery::patch, {}, choice);
}

/// Of all channels but volume.ax, which has no response.
double difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t n_channels,
                  std::size_t n_components) {
  std::vector<std::size_t> channels;
  for (std::size_t k = 0; k < n_channels; ++k)
    if (k != n_channels - 2) channels.push_back(k);
  return fem_tests::difference(a, b, channels, n_channels, n_components);
}

constexpr fem::SolverChoice directly{fem::Solver::direct, 1e-10, 100};
constexpr fem::SolverChoice iteratively{fem::Solver::iterative, 1e-10, 100};

/// A residual of 1e-10 of the load as applied is worth as much of the response to it, more where the load is
/// mostly balanced by the body force or bends a slender body: measured 3e-11 to 1.2e-10, a tenfold is left.
constexpr double same_solution = 1e-9;

void expect_agreement(const fem_tests::ShaftBody& shaft) {
  const auto direct = solve(shaft, directly), iterative = solve(shaft, iteratively);
  EXPECT_EQ(iterative.solver.used, fem::Solver::iterative) << iterative.solver.reason;
  EXPECT_LT(iterative.residual, 1e-9) << "the updated residual drifts from the true one by rounding";
  EXPECT_GT(iterative.solver.n_iterations, 4);
  const std::size_t n = direct.channels.size();
  EXPECT_LT(difference(iterative.displacement_m, direct.displacement_m, n, 3), same_solution);
  EXPECT_LT(difference(iterative.stress_Pa, direct.stress_Pa, n, 6), same_solution);
}

TEST(Solvers, AgreeOnQuadraticCells) {
  expect_agreement(fem_tests::eccentric_shaft(2));
}

/// Towards one end, cycle after cycle: the cells whose centres have a smaller z than the plane.
fem::Body refined(fem::Body body, const std::vector<double>& planes_m) {
  for (const double plane_m : planes_m) {
    const auto grid = fem::make_grid(body);
    fem::RefinementCycle cycle;
    for (std::size_t c = 0; c < grid.n_cells(); ++c) {
      double z_m = 0;
      for (int i = 0; i < grid.nodes_per_cell(); ++i)
        z_m += grid.position(grid.nodes_of(c)[i])[2] / grid.nodes_per_cell();
      if (z_m < plane_m) cycle.cells.push_back(std::int32_t(c));
    }
    body.refinements.push_back(cycle);
  }
  return body;
}

// 47 steps where the even mesh takes 40. Turns red: forces left at hanging nodes.
TEST(Solvers, AgreeOnRefinedMeshes) {
  const auto even = fem_tests::rod(8);
  auto rod = even;
  rod.body = refined(even.body, {0.05, 0.02});
  ASSERT_GT(fem::make_grid(rod.body).hanging.n(), 100u);
  expect_agreement(rod);
  const auto steps = solve(rod, iteratively).solver.n_iterations;
  EXPECT_LE(steps, 1.5 * solve(even, iteratively).solver.n_iterations);
}

TEST(Solvers, AgreeOnCubicCells) {
  auto rod = fem_tests::rod(8);
  rod.body.degree = 3;
  expect_agreement(rod);
}

TEST(Solvers, AgreeWithoutContraction) {
  auto rod = fem_tests::rod();
  rod.body.material.poisson_ratio = 0;
  expect_agreement(rod);
}

// Nearly incompressible: the smoother loses its grip on volume-preserving modes. Right or handed over.
TEST(Solvers, NearIncompressibilityIsRightEitherWay) {
  auto rod = fem_tests::rod(8);
  rod.body.material.poisson_ratio = 0.4999;
  const auto direct = solve(rod, directly), other = solve(rod, iteratively);
  const std::size_t n = direct.channels.size();
  EXPECT_LT(difference(other.displacement_m, direct.displacement_m, n, 3), same_solution)
      << other.solver.reason;
}

// A rod of 50 mm in eight sectors with cells 0.5 mm thin: aspect about 40.
TEST(Solvers, StretchedCellsAreRightEitherWay) {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, 0.005, 0.05, 0, true}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  control.largest_cell_m = 5e-4;
  control.min_scaled_jacobian = 0.1;
  const auto disc = fem_tests::build(shaft, control);
  const auto direct = solve(disc, directly), other = solve(disc, iteratively), automatic = solve(disc, {});
  const std::size_t n = direct.channels.size();
  EXPECT_GT(direct.solver.largest_aspect, 15);
  EXPECT_LT(difference(other.displacement_m, direct.displacement_m, n, 3), same_solution);
  EXPECT_EQ(automatic.solver.used, fem::Solver::direct);
  EXPECT_NE(automatic.solver.reason.find("stretched"), std::string::npos) << automatic.solver.reason;
}

// A shoulder between long plain cylinders, 94 k unknowns: one cell in fourteen is stretched more than 1 : 12,
// up to 1 : 17, and the analysed factor is expensive.
TEST(Solvers, FewCellsOfMiddlingStretchAreIteratedWhereTheFactorIsDear) {
  meshes::Shaft shaft;
  shaft.segments = {{"left", 0, 0.06, 0.04, 0, true},
                    {"thin", 0.06, 0.14, 0.04},
                    {"thick", 0.14, 0.24, 0.06},
                    {"right", 0.24, 0.3, 0.06, 0, true}};
  shaft.fillets_m = {0, 0.004, 0};
  meshes::ShaftMeshControl control;
  control.subdivisions = 2;
  control.cells_per_fillet_quarter = 4;
  control.growth = 0.5;
  const auto body = fem_tests::build(shaft, control);
  const auto automatic = solve(body, {});
  EXPECT_GT(automatic.solver.largest_aspect, 12);
  EXPECT_EQ(automatic.solver.used, fem::Solver::iterative);
  EXPECT_NE(automatic.solver.reason.find("the factor is expensive"), std::string::npos)
      << automatic.solver.reason;
  EXPECT_LT(automatic.residual, 1e-9) << "the updated residual drifts from the true one by rounding";
}

TEST(Solvers, StallFallsBackToTheDirectSolverAndSaysSo) {
  const auto rod = fem_tests::rod(8);
  const auto direct = solve(rod, directly), stalled = solve(rod, {fem::Solver::iterative, 1e-10, 3});
  EXPECT_EQ(stalled.solver.used, fem::Solver::direct);
  EXPECT_EQ(
      stalled.solver.reason,
      "the iteration did not converge after 3 steps; solved directly; half by half, the body being its own "
      "mirror image");
  EXPECT_TRUE(stalled.solver.gave_up);
  EXPECT_FALSE(direct.solver.gave_up);
  EXPECT_EQ(stalled.displacement_m, direct.displacement_m);
  EXPECT_GT(stalled.factor_gigabytes, 0);
}

TEST(Solvers, IterationRepeatsBitForBitAndScalesWithLoadAndModulus) {
  auto rod = fem_tests::rod(8);
  const auto once = solve(rod, iteratively), again = solve(rod, iteratively);
  EXPECT_EQ(once.displacement_m, again.displacement_m);
  rod.body.material.youngs_modulus_Pa *= 1024;  // a power of two: not a bit of the mantissa changes
  const auto stiff = solve(rod, iteratively);
  for (std::size_t i = 0; i < once.displacement_m.size(); ++i)
    ASSERT_EQ(stiff.displacement_m[i] * 1024, once.displacement_m[i]);
}

TEST(SolverChoice, FollowsPredictionMemoryAndKindOfCell) {
  auto body = fem_tests::rod(8);
  const auto grid = fem::make_grid(body.body);
  const auto steel = fem_tests::steel;
  const auto used = [&](double memory_bytes) {
    return fem::choose_solver(grid, steel, 12, {}, memory_bytes).used;
  };
  const auto report = fem::choose_solver(grid, steel, 12, {}, 1e12);
  EXPECT_EQ(report.used, fem::Solver::direct) << "a small body saves nothing";
  EXPECT_EQ(fem::choose_solver(grid, steel, 12, {fem::Solver::iterative, 1e-10, 100}, 1e12).used,
            fem::Solver::iterative);
  // Between the two needs of memory the one that fits is taken, whatever its time.
  ASSERT_NE(report.predicted_direct.bytes, report.predicted_iterative.bytes);
  const bool direct_is_smaller = report.predicted_direct.bytes < report.predicted_iterative.bytes;
  EXPECT_EQ(used(std::sqrt(report.predicted_direct.bytes * report.predicted_iterative.bytes) +
                 fem::bytes_beside_solver(3 * grid.n_nodes, 12)),
            direct_is_smaller ? fem::Solver::direct : fem::Solver::iterative);
  EXPECT_EQ(fem::choose_solver(grid, fem::Material{206e9, 0.4999, 7850}, 12, {}, 1e12).used,
            fem::Solver::direct);
  body.body.degree = 1;
  EXPECT_EQ(fem::choose_solver(fem::make_grid(body.body), steel, 12, {}, 1e12).used, fem::Solver::direct);
}

/// One cell of degree 2 with edges 1, 1 and `length`, in a mesh that claims so many nodes.
fem::Grid stretched_cell(std::size_t n_nodes, double length) {
  fem::Grid grid;
  grid.n_nodes = n_nodes;
  for (int i = 0; i < 27; ++i) {
    grid.cell_nodes.push_back(i);
    for (const double x : {0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * length * (i / 9)}) grid.xyz_m.push_back(x);
  }
  grid.volume_id.push_back(1);
  return grid;
}

TEST(SolverChoice, LargeBodiesOfCompactCellsAreIterated) {
  const auto steel = fem_tests::steel;
  const auto used = [&](double length) {
    return fem::choose_solver(stretched_cell(200000, length), steel, 12, {}, 1e12).used;
  };
  EXPECT_EQ(used(2), fem::Solver::iterative);
  EXPECT_EQ(used(1 / 2.0), fem::Solver::iterative);
  EXPECT_EQ(used(40), fem::Solver::direct);
  EXPECT_EQ(used(1 / 40.0), fem::Solver::direct);
}

TEST(SolverChoice, AspectIsThatOfTheLongestCell) {
  EXPECT_DOUBLE_EQ(fem::largest_aspect(stretched_cell(27, 7)), 7);
}

}  // namespace
