// Krylov spaces from one vector have one direction of each eigenspace. All modes of repeated frequencies are
// found all the same, with what is left out left out, in the inner product of the mass.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "fem/base/values/constants.h"
#include "fem/base/values/errors.h"
#include "fem/equations/operators/mass_matrix.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/solve/modes/krylov_schur.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/block_mesh.h"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// K and M with known modes: X'MX = I, K X = M X diag(squares).
struct KnownModes {
  VectorXd squares;
  MatrixXd shapes, stiffness, mass, inverse;

  fem::VibrationProblem problem() const {
    return {squares.size(),
            [this](const MatrixXd& x) { return MatrixXd(stiffness * x); },
            [this](const MatrixXd& x) { return MatrixXd(mass * x); },
            [this](const MatrixXd& f) { return MatrixXd(inverse * f); },
            MatrixXd(squares.size(), 0),
            {}};
  }
};

/// @param root  any invertible R: M = R'R
KnownModes with_mass(const VectorXd& squares, const MatrixXd& turn, const MatrixXd& root) {
  KnownModes known;
  known.squares = squares;
  known.mass = root.transpose() * root;
  known.shapes = root.inverse() * turn;
  known.stiffness = root.transpose() * turn * squares.asDiagonal() * turn.transpose() * root;
  known.inverse = known.shapes * squares.cwiseInverse().asDiagonal() * known.shapes.transpose();
  return known;
}

/// Once 1, twice 2, three times 3, four times 4, then simple ones.
VectorXd repeated_squares() {
  VectorXd squares = VectorXd::LinSpaced(60, -4, 55);
  squares.head(10) << 1, 2, 2, 3, 3, 3, 4, 4, 4, 4;
  return squares;
}

/// Masses of entries that differ by a hundred, not diagonal: the wrong inner product has other modes.
KnownModes repeated() {
  std::mt19937 engine(7);
  const auto random = [&](Eigen::Index rows, Eigen::Index columns) {
    MatrixXd x(rows, columns);
    for (auto& entry : x.reshaped()) entry = double(engine()) / double(std::mt19937::max()) - 0.5;
    return x;
  };
  const MatrixXd turn = random(60, 60).householderQr().householderQ();
  MatrixXd root = 0.2 * random(60, 60);
  root.diagonal() += VectorXd::LinSpaced(60, 1, 10);
  return with_mass(repeated_squares(), turn, root);
}

/// 1e-12: rounding of matrices whose condition is some 1e4; the search's error is the square of 1e-10.
void expect_lowest(const KnownModes& known, const fem::Eigenpairs& found, const VectorXd& squares) {
  ASSERT_EQ(found.value.size(), squares.size());
  for (Eigen::Index i = 0; i < squares.size(); ++i) EXPECT_NEAR(found.value[i] / squares[i], 1, 1e-12) << i;
  const MatrixXd& x = found.vector;
  const MatrixXd gram = x.transpose() * known.mass * x;
  EXPECT_LT((gram - MatrixXd::Identity(x.cols(), x.cols())).cwiseAbs().maxCoeff(), 1e-12);
  const MatrixXd rest = known.stiffness * x - known.mass * x * found.value.asDiagonal();
  EXPECT_LT(rest.norm(), 1e-8 * (known.stiffness * x).norm());  // the search's 1e-10, times the stiffer modes
}

TEST(RepeatedModes, OfAnyMultiplicity) {
  const auto known = repeated();
  for (int n = 1; n <= 12; ++n) {
    SCOPED_TRACE(n);
    expect_lowest(known, fem::lowest_modes(known.problem(), n), known.squares.head(n));
  }
}

// A start without any share in the simple lowest mode and in all but one of the modes of each repeated
// square: with diagonal matrices not even rounding brings one into its Krylov space.
TEST(RepeatedModes, WhateverTheStartLacks) {
  const Eigen::Index n = 60;
  const auto known = with_mass(repeated_squares(), MatrixXd::Identity(n, n),
                               VectorXd::LinSpaced(n, 1, 10).asDiagonal().toDenseMatrix());
  auto problem = known.problem();
  problem.start = VectorXd::Ones(n);
  for (const int missing : {0, 2, 4, 5, 7, 8, 9}) problem.start[missing] = 0;
  for (const int n_modes : {1, 3, 6, 10, 12}) {
    SCOPED_TRACE(n_modes);
    expect_lowest(known, fem::lowest_modes(problem, n_modes), known.squares.head(n_modes));
  }
}

/// In other units, by powers of two: no digit changes.
KnownModes scaled(KnownModes known, int stiffer, int heavier) {
  known.stiffness *= std::exp2(stiffer);
  known.inverse *= std::exp2(-stiffer);
  known.mass *= std::exp2(heavier);
  known.shapes *= std::exp2(-heavier / 2);
  known.squares *= std::exp2(stiffer - heavier);
  return known;
}

// What is left out is not found, though the inverse moves most along it. Light bodies are as soft as if the
// modes left out were rigid motions: SLEPc takes them for K's null space then.
TEST(RepeatedModes, BesideThoseLeftOut) {
  for (const int lighter : {0, 80}) {
    const auto known = scaled(repeated(), -lighter, -lighter);
    auto problem = known.problem();
    problem.left_out.resize(60, 3);
    problem.left_out << known.shapes.col(0), known.shapes.col(1), known.shapes.col(4);
    VectorXd others(7);
    others << 2, 3, 3, 4, 4, 4, 4;
    const auto found = fem::lowest_modes(problem, 7);
    expect_lowest(known, found, others);
    EXPECT_LT((problem.left_out.transpose() * known.mass * found.vector).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// No limit of the search depends on units.
TEST(RepeatedModes, InAnyUnits) {
  const auto known = repeated();
  const auto found = fem::lowest_modes(known.problem(), 7);
  for (const auto& [stiffer, heavier] : {std::pair{90, -80}, {-200, 30}, {200, 0}}) {
    const auto there = fem::lowest_modes(scaled(known, stiffer, heavier).problem(), 7);
    EXPECT_EQ(there.value, found.value * std::exp2(stiffer - heavier));
    EXPECT_EQ(there.vector, found.vector * std::exp2(-heavier / 2));
  }
}

TEST(RepeatedModes, SameBitsEveryTime) {
  const auto known = repeated();
  const auto first = fem::lowest_modes(known.problem(), 9), second = fem::lowest_modes(known.problem(), 9);
  EXPECT_EQ(first.value, second.value);
  EXPECT_EQ(first.vector, second.vector);
}

TEST(RepeatedModes, FailuresComeThrough) {
  const auto known = repeated();
  for (int failing = 0; failing < 3; ++failing) {
    auto problem = known.problem();
    auto& product = failing == 0 ? problem.stiffness : failing == 1 ? problem.mass : problem.inverse;
    int left = failing == 0 ? 0 : 30;
    problem.left_out = known.shapes.leftCols(1);  // whose stiffness SLEPc asks for
    product = [good = product, &left](const MatrixXd& x) {
      if (left-- == 0) throw std::domain_error("a product failed");
      return good(x);
    };
    EXPECT_THROW(fem::lowest_modes(problem, 5), std::domain_error) << failing;
    EXPECT_EQ(fem::lowest_modes(known.problem(), 2).value.size(), 2) << "afterwards";
  }
}

// Beside all 60 there is nothing to search in: SLEPc's error becomes ours, and it says nothing itself.
TEST(RepeatedModes, ErrorsOfSlepcAreSolveFailed) {
  const auto known = repeated();
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string text = "accepted";
  try {
    fem::lowest_modes(known.problem(), 60);
  } catch (const fem::SolveFailed& error) {
    text = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(text.find("do not converge"), std::string::npos) << text;
}

/// w^2 of a free body by a dense solver, ascending, without the six rigid motions.
VectorXd dense_squares(const fem::Body& body) {
  const auto grid = fem::make_grid(body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  const auto colours = fem::colour_cells(grid, cells);
  auto stiffness = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, colours, graph, fem::lame(body.material), stiffness);
  const fem::MassMatrix mass(grid, colours, graph, body.material.density_kg_m3);
  const MatrixXd all = MatrixXd::Identity(stiffness.n, stiffness.n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> dense(fem::multiply(stiffness, all), mass * all,
                                                                 Eigen::EigenvaluesOnly);
  return dense.eigenvalues().tail(stiffness.n - 6);
}

int most_repeated(const VectorXd& squares) {
  int most = 1;
  for (Eigen::Index i = 0, run = 1; i + 1 < squares.size(); ++i) {
    run = squares[i + 1] < squares[i] * (1 + 1e-9) ? run + 1 : 1;
    most = std::max(most, int(run));
  }
  return most;
}

/// 1e-8: the dense solver's rounding, eps times its largest w^2 over these, some 1e4 to 1e6.
void expect_those_of_a_dense_solver(const fem::Body& body, int n_modes, int repeated) {
  const VectorXd expected = dense_squares(body).head(n_modes);
  EXPECT_EQ(most_repeated(expected), repeated);
  const auto modes = fem::Model(body).natural_frequencies(n_modes);
  for (Eigen::Index i = 0; i < n_modes; ++i)
    EXPECT_NEAR(std::pow(2 * fem::pi * modes[std::size_t(i)].frequency_Hz, 2) / expected[i], 1, 1e-8) << i;
}

TEST(RepeatedModes, OfACube) {
  fem::Body cube;
  cube.mesh = verification::hexahedra_of({{2, 2, 2}, [](const Eigen::Vector3d& x) { return x; }});
  cube.material = fem_tests::steel;
  expect_those_of_a_dense_solver(cube, 30, 3);
}

TEST(RepeatedModes, OfARoundBar) {
  auto bar = fem_tests::rod(8).body;
  bar.degree = 1;  // small enough for the dense solver, and an octagon has the pairs of a circle
  expect_those_of_a_dense_solver(bar, 20, 2);
}

}  // namespace
