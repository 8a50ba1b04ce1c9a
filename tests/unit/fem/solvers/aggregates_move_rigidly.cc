#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fem/loads/surface_loads.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/multigrid/aggregates.h"
#include "fem/multigrid/rigid_galerkin.h"
#include "fem/operators/stiffness.h"
#include "fem/solvers/iterative_solve.h"
#include "fem/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

/// The stiffness of trilinear cells in a small shaft.
struct Level {
  Level() {
    auto shaft = fem_tests::eccentric_shaft(2);
    shaft.body.degree = 1;
    grid = fem::make_grid(shaft.body);
    const auto cells = fem::cells_of_nodes(grid);
    graph = fem::make_node_graph(grid, cells);
    matrix = fem::make_matrix(graph);
    fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame({1, 0.3, 1}), matrix);
    rows = fem::full_rows(graph, matrix);
    aggregates = fem::aggregate_nodes(rows, 1, 0.08);
    spanned = fem::span_motions(aggregates, fem::rigid_motions(grid.xyz_m));
  }
  fem::Grid grid;
  fem::NodeGraph graph;
  fem::SymmetricMatrix matrix;
  fem::BlockMatrix<double> rows;
  fem::Aggregates aggregates;
  fem::AggregateMotions spanned;
};

template <typename T>
Eigen::MatrixXd dense(const fem::BlockMatrix<T>& m) {
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(m.height * Eigen::Index(m.n_rows()), m.width * Eigen::Index(m.n_columns));
  for (std::size_t i = 0; i < m.n_rows(); ++i)
    for (auto k = m.begin[i]; k < m.begin[i + 1]; ++k)
      for (int r = 0; r < m.height; ++r)
        for (int c = 0; c < m.width; ++c)
          result(m.height * Eigen::Index(i) + r, m.width * m.column[k] + c) = m.at(k)[r * m.width + c];
  return result;
}

TEST(Aggregates, FullRowsAreTheMatrix) {
  const Level level;
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(level.matrix.n, 3);
  const Eigen::MatrixXd expected = fem::multiply(level.matrix, x), y = dense(level.rows) * x;
  EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());
}

TEST(Aggregates, HoldEveryNodeAndAreSmall) {
  const Level level;
  std::set<std::int32_t> found(level.aggregates.of_node.begin(), level.aggregates.of_node.end());
  EXPECT_EQ(found.size(), level.aggregates.n);
  EXPECT_EQ(*found.begin(), 0);
  const double size = double(level.grid.n_nodes) / double(level.aggregates.n);
  EXPECT_GT(size, 8) << "nodes per aggregate: the level below would be too large";
  EXPECT_LT(size, 60) << "the level below would be too poor";
}

// Rigid motion costs no energy on any level: P reproduces it, to the rounding of its floats.
TEST(Aggregates, InterpolateRigidMotion) {
  const Level level;
  const auto p = fem::smoothed_interpolation(level.rows, level.aggregates, level.spanned.basis, 0.5);
  const auto motions = fem::rigid_motions(level.grid.xyz_m);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  const Eigen::Map<const Rows> rigid(motions.data(), 3 * Eigen::Index(level.grid.n_nodes), 6),
      below(level.spanned.motion.data(), 6 * Eigen::Index(level.aggregates.n), 6);
  EXPECT_LT((dense(p) * below - rigid).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((dense(level.rows) * rigid).cwiseAbs().maxCoeff(),
            1e-12 * dense(level.rows).cwiseAbs().maxCoeff());
}

TEST(Aggregates, LevelBelowIsTheGalerkinProduct) {
  const Level level;
  const auto p = fem::smoothed_interpolation(level.rows, level.aggregates, level.spanned.basis, 0.5);
  const Eigen::MatrixXd full = dense(p), expected = full.transpose() * dense(level.rows) * full,
                        below = dense(fem::galerkin_product(level.rows, p));
  EXPECT_LT((below - expected).norm(), 1e-12 * expected.norm());
}

TEST(Aggregates, FactorHoldsOneAggregate) {
  const Level level;
  const auto p = fem::smoothed_interpolation(level.rows, level.aggregates, level.spanned.basis, 0.5);
  const auto below = fem::galerkin_product(level.rows, p);
  const int held = 1;
  const auto factor = fem::factorise_held(below, held);
  // A force that balances itself is met exactly, whichever aggregate is held.
  const Eigen::MatrixXd force = dense(below) * Eigen::MatrixXd::Random(below.n_columns * 3, 2);
  Eigen::MatrixXd free = force;
  free.middleRows<6>(6 * held).setZero();
  const Eigen::MatrixXd u = factor->solve(free);
  EXPECT_LT((dense(below) * u - force).norm(), 1e-8 * force.norm());
  EXPECT_EQ(u.middleRows<6>(6 * held).norm(), 0);
}

TEST(Aggregates, SiblingsStayTogether) {
  const Level level;
  const auto p = fem::smoothed_interpolation(level.rows, level.aggregates, level.spanned.basis, 0.5);
  const auto next = fem::aggregate_nodes(fem::galerkin_product(level.rows, p), 2, 0.08);
  for (std::size_t i = 0; i < next.of_node.size(); i += 2) EXPECT_EQ(next.of_node[i], next.of_node[i + 1]);
  EXPECT_LT(2 * next.n, level.aggregates.n);
}

TEST(Aggregates, TransposeOfBlocks) {
  const Level level;
  const auto p = fem::smoothed_interpolation(level.rows, level.aggregates, level.spanned.basis, 0.5);
  EXPECT_EQ(dense(fem::transpose(p)), dense(p).transpose());
}

// Single nodes and nodes on a line do not tell all motions apart.
TEST(Aggregates, MotionsThatCannotBeToldApartAreLeftOut) {
  const fem::Aggregates aggregates{3, {0, 1, 1, 2, 2, 2}};
  const auto spanned = fem::span_motions(
      aggregates, fem::rigid_motions({5, 5, 5, 0, 0, 0, 0, 0, 1, 1, 0, 0, 2, 0, 0, 2, 1, 0}));
  EXPECT_EQ(spanned.rank, (std::vector<int>{3, 5, 6}));
}

struct Answer {
  fem::Solution solution;
  std::string failure;
};
/// @param unbalanced  size of a rest of resultant force, relative to each load
Answer solve(const fem_tests::ShaftBody& shaft, fem::CoarseLevel level, const fem::Grid& grid,
             double unbalanced = 0) {
  using Component = fem::SurfaceResultant::Component;
  fem::BalancedLoads loads;
  const auto integrals = fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid)));
  std::vector<fem::UnitLoad> unit;
  for (const auto c : {Component::fx, Component::fz, Component::my, Component::torque})
    unit.push_back(fem_tests::resultant(shaft, "end_2", c));
  loads.force = fem::load_vectors(grid, integrals, 7850, unit);
  loads.norm = loads.force.colwise().norm();
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
  const fem::RigidBalance rigid(grid, integrals);
  rigid.balance(loads.force);
  const Eigen::VectorXd along = fem::rigid_modes(grid, {0, 0, 0}).col(0).normalized();
  loads.force += unbalanced * along * loads.norm;
  fem::SolverChoice choice;
  choice.coarse_level = level;
  Answer answer;
  auto found = fem::solve_iteratively(
      grid, shaft.body.material, loads, choice, [](double, const std::string&) {}, answer.failure);
  if (found) answer.solution = std::move(*found);
  if (found) rigid.remove_motion(answer.solution.displacement);
  return answer;
}

fem_tests::ShaftBody slender_rod(int n_sectors, double stretch) {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, 0.2, 0.04, 0, true}};
  meshes::ShaftMeshControl control;
  control.n_sectors = n_sectors;
  control.largest_cell_m = stretch * 0.1 / n_sectors;
  return fem_tests::build(shaft, control);
}

/// 1e-10 of the load is a tenfold of that in the answer where loads bend a slender body (solvers_agree.cc).
constexpr double same_answer = 1e-9;

// Two refinements, a hundredfold of unknowns in all would need the same iterations; the exact level below is
// the measure. A level that loses the rotations, or an interpolation without smoothing, takes more than twice
// as many.
TEST(Aggregates, IterationsDoNotGrowWithTheMesh) {
  int first = 0;
  for (const int n_sectors : {8, 12, 20}) {
    const auto rod = slender_rod(n_sectors, 1);
    const auto grid = fem::make_grid(rod.body);
    const auto exact = solve(rod, fem::CoarseLevel::factorised, grid),
               other = solve(rod, fem::CoarseLevel::aggregated, grid);
    ASSERT_EQ(other.failure + exact.failure, "");
    EXPECT_LT((other.solution.displacement - exact.solution.displacement).norm(),
              same_answer * exact.solution.displacement.norm());
    EXPECT_LE(other.solution.n_iterations, 1.5 * exact.solution.n_iterations) << 3 * grid.n_nodes;
    if (first == 0) first = other.solution.n_iterations;
    EXPECT_LE(other.solution.n_iterations, 1.3 * first) << 3 * grid.n_nodes;
    RecordProperty("iterations_" + std::to_string(3 * grid.n_nodes), other.solution.n_iterations);
  }
}

TEST(Aggregates, StretchedCellsTakeAtMostHalfAsManyStepsAgain) {
  const auto rod = slender_rod(12, 2.5);
  const auto grid = fem::make_grid(rod.body);
  const auto exact = solve(rod, fem::CoarseLevel::factorised, grid),
             other = solve(rod, fem::CoarseLevel::aggregated, grid);
  ASSERT_EQ(other.failure + exact.failure, "");
  EXPECT_LE(other.solution.n_iterations, 1.5 * exact.solution.n_iterations);
}

// What rounding leaves of resultants in the residual must not be answered by large displacements: a coarse
// level that does so lets the residual grow again once it has fallen to some thousand times of it.
TEST(Aggregates, ForcesThatDoNotQuiteBalanceAreMetDownToWhatCannotBe) {
  const auto rod = slender_rod(8, 1);
  const auto grid = fem::make_grid(rod.body);
  for (const auto level : {fem::CoarseLevel::aggregated, fem::CoarseLevel::factorised}) {
    const auto answer = solve(rod, level, grid, 3e-12);
    EXPECT_EQ(answer.failure, "");
    EXPECT_LT(answer.solution.residual, 1.01e-10);
  }
}

TEST(Aggregates, RepeatBitForBit) {
  const auto rod = slender_rod(8, 1);
  const auto grid = fem::make_grid(rod.body);
  EXPECT_EQ(solve(rod, fem::CoarseLevel::aggregated, grid).solution.displacement,
            solve(rod, fem::CoarseLevel::aggregated, grid).solution.displacement);
}

}  // namespace
