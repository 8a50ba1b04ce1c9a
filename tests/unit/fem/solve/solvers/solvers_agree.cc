#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/solve/solvers/solver_prediction.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

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

constexpr fem::SolverChoice directly{fem::Solver::direct};
constexpr fem::SolverChoice iteratively{fem::Solver::iterative};

/// A residual of 1e-10 of the load as applied is worth as much of the response to it, more where the load is
/// mostly balanced by the body force or bends a slender body.
constexpr double same_solution = 1e-9;

/// @return steps of the iteration
int expect_agreement(const fem_tests::ShaftBody& shaft, double largest_difference = same_solution) {
  const auto direct = solve(shaft, directly), iterative = solve(shaft, iteratively);
  EXPECT_EQ(iterative.solver.used, fem::Solver::iterative) << iterative.solver.reason;
  EXPECT_LT(iterative.residual, 1e-9) << "the updated residual drifts from the true one by rounding";
  EXPECT_GT(iterative.solver.n_iterations, 4);
  const std::size_t n = direct.channels.size();
  EXPECT_LT(difference(iterative.displacement_m, direct.displacement_m, n, 3), largest_difference);
  EXPECT_LT(difference(iterative.stress_Pa, direct.stress_Pa, n, 6), largest_difference);
  return iterative.solver.n_iterations;
}

TEST(Solvers, AgreeOnQuadraticCells) {
  EXPECT_LE(expect_agreement(fem_tests::eccentric_shaft(2)), 40);
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

// Turns red: forces left at hanging nodes, hanging corners as vertices of the level below.
TEST(Solvers, AgreeOnRefinedMeshes) {
  const auto even = fem_tests::rod(8);
  auto rod = even;
  rod.body = refined(even.body, {0.05, 0.02});
  ASSERT_GT(fem::make_grid(rod.body).hanging.n(), 100u);
  EXPECT_LE(expect_agreement(rod), 1.5 * solve(even, iteratively).solver.n_iterations);
}

// A bent bar, P2 cells with curved edges.
TEST(Solvers, AgreeOnTetrahedra) {
  const auto grid = fem_tests::tetrahedra_block({4, 4, 12}, [](const fem_tests::Point& x) {
    return fem_tests::Point(x[0] + 0.05 * x[2] * x[2], x[1], 4 * x[2]);
  });
  fem_tests::ShaftBody bar;
  bar.body.mesh = fem_tests::cells_of(grid);
  bar.body.material = fem_tests::steel;
  for (const int end : {1, 2}) {
    fem::LoadSurface face;
    face.kind = fem::LoadSurface::Kind::face;
    face.boundary_id = 4 + end;
    bar.ports["end_" + std::to_string(end)] = face;
  }
  EXPECT_LE(expect_agreement(bar), 20);
}

TEST(Solvers, AgreeOnClampedBodies) {
  auto rod = fem_tests::rod(8);
  rod.body.clamps = {{rod.ports.at("end_1").boundary_id}};
  const auto direct = solve(rod, directly), iterative = solve(rod, iteratively);
  const std::size_t n = direct.channels.size();
  EXPECT_EQ(iterative.solver.used, fem::Solver::iterative);
  EXPECT_LE(iterative.solver.n_iterations, 40);
  EXPECT_LT(fem_tests::difference(iterative.displacement_m, direct.displacement_m, {0, 2, 4, 6, 7}, n, 3),
            same_solution);
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

// A disc of 50 mm in eight sectors, all cells 0.5 mm thin, aspect about 40: 107 steps. It bends easily, so
// that residuals are worth more of the response.
TEST(Solvers, AgreeOnStretchedCells) {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, 0.005, 0.05, 0, true}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  control.largest_cell_m = 5e-4;
  control.min_scaled_jacobian = 0.1;
  const auto disc = fem_tests::build(shaft, control);
  EXPECT_GT(solve(disc, {}).solver.largest_aspect, 15);
  EXPECT_LE(expect_agreement(disc, 1e-8), 120);
}

TEST(Solvers, IterationThatDoesNotEndTurnsToTheFactor) {
  const auto rod = fem_tests::rod(8);
  const auto found = solve(rod, {fem::Solver::iterative, 1e-10, 3});
  EXPECT_EQ(found.solver.used, fem::Solver::direct);
  EXPECT_NE(found.solver.reason.find("did not converge after 3 steps"), std::string::npos)
      << found.solver.reason;
  EXPECT_EQ(found.displacement_m, solve(rod, {fem::Solver::direct}).displacement_m);
}

// Turns red: options of other programs taken for ours.
TEST(Solvers, TakesOwnOptionsOfPetscAlone) {
  const auto rod = fem_tests::rod(8);
  const auto steps = [&](const char* options) {
    setenv("PETSC_OPTIONS", options, 1);
    const int n = solve(rod, iteratively).solver.n_iterations;
    unsetenv("PETSC_OPTIONS");
    return n;
  };
  const int usual = steps("");
  EXPECT_EQ(steps("-mg_levels_ksp_max_it 1 -ksp_type preonly"), usual);
  EXPECT_GT(steps("-ksp_rtol 1 -fem_mg_levels_ksp_max_it 1 -pc_type none"), usual);
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

TEST(SolverChoice, IsTheFactorUnlessAskedOtherwise) {
  auto body = fem_tests::rod(8);
  const auto used = [&](fem::Solver solver) {
    return fem::choose_solver(fem::make_grid(body.body), 12, {solver}, 1e12).used;
  };
  EXPECT_EQ(used(fem::Solver::automatic), fem::Solver::direct);
  EXPECT_EQ(used(fem::Solver::direct), fem::Solver::direct);
  EXPECT_EQ(used(fem::Solver::iterative), fem::Solver::iterative);
  body.body.degree = 1;
  EXPECT_EQ(used(fem::Solver::iterative), fem::Solver::direct) << "no level below";
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

TEST(SolverChoice, AspectIsThatOfTheLongestCell) {
  EXPECT_DOUBLE_EQ(fem::largest_aspect(stretched_cell(27, 7)), 7);
}

}  // namespace
