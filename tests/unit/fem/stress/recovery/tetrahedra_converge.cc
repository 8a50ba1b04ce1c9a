// Displacements prescribed on the whole surface: a field that satisfies Navier's equations without body force
// is the exact solution.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/stress/recovery/stress_recovery.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using fem_tests::Point;
using Gradient = Eigen::Matrix3d;
constexpr fem::Material material{1, 0.3, 1};

/// A displacement and its gradient (row: component).
struct Exact {
  std::function<Point(const Point&)> u;
  std::function<Gradient(const Point&)> gradient;
};

const Exact linear = {[](const Point& x) { return Point(x[0] + 2 * x[1], x[2] - x[1], 0.5 * x[0] + x[2]); },
                      [](const Point&) {
                        Gradient g;
                        g << 1, 2, 0, 0, -1, 1, 0.5, 0, 1;
                        return g;
                      }};

/// The gradient of the harmonic function exp(x) sin(y) + exp(2 y) cos(2 z) / 2.
const Exact smooth = {[](const Point& x) {
                        return Point(
                            std::exp(x[0]) * std::sin(x[1]),
                            std::exp(x[0]) * std::cos(x[1]) + std::exp(2 * x[1]) * std::cos(2 * x[2]),
                            -std::exp(2 * x[1]) * std::sin(2 * x[2]));
                      },
                      [](const Point& x) {
                        const double a = std::exp(x[0]) * std::sin(x[1]), b = std::exp(x[0]) * std::cos(x[1]),
                                     c = 2 * std::exp(2 * x[1]) * std::cos(2 * x[2]),
                                     d = 2 * std::exp(2 * x[1]) * std::sin(2 * x[2]);
                        Gradient g;
                        g << a, b, 0, b, c - a, -d, 0, -d, -c;
                        return g;
                      }};

Gradient stress(const Gradient& g) {
  const auto elastic = fem::lame(material);
  return elastic.lambda_Pa * g.trace() * Gradient::Identity() + elastic.mu_Pa * (g + g.transpose());
}

fem::RowMajor solve(const fem::Grid& grid, const Exact& exact) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  auto matrix = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(material), matrix);
  std::vector<int> unknown(3 * grid.n_nodes, 0);
  for (const auto& face : grid.boundary)
    for (const auto node : fem::nodes_of_face(grid, face.cell, face.face))
      for (int d = 0; d < 3; ++d) unknown[3 * node + d] = -1;
  int n = 0;
  for (auto& number : unknown) number = number < 0 ? -1 : n++;
  fem::RowMajor u(grid.n_nodes, 3);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) u.row(i) = exact.u(Point(grid.position(i)));
  Eigen::VectorXd force = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int64_t j = 0; j < matrix.n; ++j)
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k) {
      const auto i = matrix.row[k];
      if (unknown[i] >= 0 && unknown[j] >= 0) entries.emplace_back(unknown[i], unknown[j], matrix.value[k]);
      if (unknown[i] >= 0 && unknown[j] < 0) force[unknown[i]] -= matrix.value[k] * u(j / 3, j % 3);
      if (unknown[i] < 0 && unknown[j] >= 0) force[unknown[j]] -= matrix.value[k] * u(i / 3, i % 3);
    }
  Eigen::SparseMatrix<double> k(n, n);
  k.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(k).solve(force);
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i] >= 0) u(i / 3, i % 3) = solution[unknown[i]];
  return u;
}

struct Errors {
  double displacement = 0, average = 0, patches = 0, average_mean = 0, patches_mean = 0;
};

Errors errors(const fem::Grid& grid, const Exact& exact) {
  const auto u = solve(grid, exact);
  const auto cells = fem::cells_of_nodes(grid);
  const auto elastic = fem::lame(material);
  fem::RowMajor average(grid.n_nodes, 6), patches(grid.n_nodes, 6);
  fem::average_stress(grid, cells, elastic, u, average);
  fem::recover_by_patches(grid, cells, {}, fem::make_samples(grid, {}),
                          fem::stress_at_samples(grid, {}, elastic, u), patches);
  Errors e;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const Point x(grid.position(i));
    e.displacement = std::max(e.displacement, (u.row(i).transpose() - exact.u(x)).cwiseAbs().maxCoeff());
    const Gradient s = stress(exact.gradient(x));
    Eigen::Matrix<double, 1, 6> theirs;
    theirs << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
    e.average = std::max(e.average, (average.row(i) - theirs).cwiseAbs().maxCoeff());
    e.patches = std::max(e.patches, (patches.row(i) - theirs).cwiseAbs().maxCoeff());
    e.average_mean += (average.row(i) - theirs).squaredNorm() / grid.n_nodes;
    e.patches_mean += (patches.row(i) - theirs).squaredNorm() / grid.n_nodes;
  }
  e.average_mean = std::sqrt(e.average_mean);
  e.patches_mean = std::sqrt(e.patches_mean);
  return e;
}

const auto bend = [](const Point& x) {
  return Point(x[0] + 0.05 * std::sin(3 * x[1]), x[1] + 0.05 * std::sin(2 * x[2] + x[0]),
               x[2] + 0.04 * x[0] * x[1]);
};

TEST(Tetrahedra, LinearFieldsAreExactOnIrregularAndCurvedCells) {
  for (const auto& grid : {fem_tests::irregular_cube(3), fem_tests::tetrahedra_cube(3, bend)}) {
    const auto e = errors(grid, linear);
    EXPECT_LT(e.displacement, 1e-13);  // of 3; rounding
    EXPECT_LT(e.average, 1e-11);
    EXPECT_LT(e.patches, 1e-11);
  }
}

// Quadratic displacement: order 3, the cells' own stress order 2. Inside the fits have one order more; at the
// surface they are one-sided, and the largest error keeps order 2.
void expect_orders(const Errors& coarse, const Errors& fine) {
  const auto order = [](double a, double b) { return std::log2(a / b); };
  std::ostringstream text;
  text << order(coarse.displacement, fine.displacement) << ", average " << order(coarse.average, fine.average)
       << ", rms " << order(coarse.average_mean, fine.average_mean) << ", patches "
       << order(coarse.patches, fine.patches) << ", rms " << order(coarse.patches_mean, fine.patches_mean)
       << "; rms errors " << fine.average_mean << " " << fine.patches_mean;
  SCOPED_TRACE(text.str());
  EXPECT_GT(order(coarse.displacement, fine.displacement), 2.7);
  EXPECT_NEAR(order(coarse.average_mean, fine.average_mean), 2, 0.3);
  EXPECT_GT(order(coarse.patches_mean, fine.patches_mean), 2.35);
  EXPECT_GT(order(coarse.patches, fine.patches), 1.7);
  EXPECT_LT(fine.patches_mean, fine.average_mean);
}

TEST(Tetrahedra, SmoothFieldsConvergeOnCurvedCells) {
  expect_orders(errors(fem_tests::tetrahedra_cube(4, bend), smooth),
                errors(fem_tests::tetrahedra_cube(8, bend), smooth));
}

TEST(Tetrahedra, SmoothFieldsConvergeOnIrregularCells) {
  expect_orders(errors(fem_tests::irregular_cube(4), smooth), errors(fem_tests::irregular_cube(8), smooth));
}

}  // namespace
