#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/stress/recovery/stress_recovery.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Point = Eigen::Vector3d;

/// n^3 cells on the unit cube, its nodes moved by `bend`.
fem::Grid cube(int n, int degree, const std::function<Point(const Point&)>& bend) {
  fem::Grid grid;
  grid.degree = degree;
  const auto table = fem::nodes_in_cell(grid.shape());
  const int m = n * degree + 1;
  grid.n_nodes = std::size_t(m) * m * m;
  grid.xyz_m.resize(3 * grid.n_nodes);
  for (int c = 0; c < n * n * n; ++c) {
    const std::array<int, 3> cell = {c % n, c / n % n, c / n / n};
    for (int i = 0; i < grid.nodes_per_cell(); ++i) {
      const int k = degree + 1;
      const std::array<int, 3> local = {i % k, i / k % k, i / k / k};
      std::size_t node = 0;
      Point x;
      for (int d = 2; d >= 0; --d) {
        node = node * m + cell[d] * degree + local[d];
        x[d] = (cell[d] + table.point[i][d]) / n;
      }
      const Point moved = bend(x);
      for (int d = 0; d < 3; ++d) grid.xyz_m[3 * node + d] = moved[d];
      grid.cell_nodes.push_back(static_cast<std::int32_t>(node));
    }
    for (int d = 0; d < 3; ++d) {
      if (cell[d] == 0) grid.boundary.push_back({c, 2 * d, 1});
      if (cell[d] == n - 1) grid.boundary.push_back({c, 2 * d + 1, 1});
    }
    grid.volume_id.push_back(1);
  }
  return grid;
}

/// Largest nodal error for a field known at the samples: inside the cells only, and on the boundary too.
double recovery_error(const fem::Grid& grid, const std::function<double(const Point&)>& field) {
  const auto cells = fem::cells_of_nodes(grid);
  double worst = 0;
  for (const auto& free : {std::vector<fem::BoundaryFace>{}, grid.boundary}) {
    const auto samples = fem::make_samples(grid, free);
    fem::RowMajor values(samples.cell.size(), 1), nodal(grid.n_nodes, 1);
    for (std::size_t s = 0; s < samples.cell.size(); ++s) values(s, 0) = field(samples.position.col(s));
    fem::recover_by_patches(grid, cells, {}, samples, values, nodal);
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      worst = std::max(worst, std::abs(nodal(i, 0) - field(Point(grid.position(i)))));
  }
  return worst;
}

const auto straight = [](const Point& x) { return x; };
const auto skewed = [](const Point& x) {
  return Point(x[0] + 0.3 * x[1], 0.5 * x[1] - 0.2 * x[2], x[2] + 0.1 * x[0]);
};
const auto curved = [](const Point& x) {
  return Point(x[0] + 0.05 * std::sin(3 * x[1]), x[1] + 0.05 * std::sin(2 * x[2] + x[0]),
               x[2] + 0.04 * x[0] * x[1]);
};

TEST(PatchRecovery, TriQuadraticFieldsAreExactOnBoxes) {
  const auto field = [](const Point& x) {
    return 1 + x[0] - 2 * x[1] * x[1] + 3 * x[0] * x[0] * x[1] * x[1] * x[2] * x[2] - x[0] * x[2] * x[2];
  };
  EXPECT_LT(recovery_error(cube(3, 2, straight), field), 1e-12);
}

TEST(PatchRecovery, QuadraticFieldsAreExactOnSkewedAndCurvedCells) {
  const auto field = [](const Point& x) {
    return 1 + x[0] - 2 * x[1] * x[1] + 3 * x[0] * x[1] - x[2] * x[2] + x[1] * x[2];
  };
  EXPECT_LT(recovery_error(cube(3, 2, skewed), field), 1e-12);
  EXPECT_LT(recovery_error(cube(3, 2, curved), field), 1e-12);
}

// Corners of the core where three or five cells meet around an edge, fans, shifted rings, boundary nodes: all
// of it.
TEST(PatchRecovery, QuadraticFieldsAreExactOnAShaft) {
  const auto grid = fem::make_grid(fem_tests::eccentric_shaft().body);
  const auto field = [](const Point& x) {
    const Point s = x / 0.06;
    return 1 + s[0] - 2 * s[1] * s[1] + 3 * s[0] * s[1] - s[2] * s[2] + s[1] * s[2];
  };
  EXPECT_LT(recovery_error(grid, field), 1e-10);
}

TEST(PatchRecovery, Degrees1And3AreExactForFieldsOfTheirDegree) {
  EXPECT_LT(recovery_error(cube(3, 1, skewed), [](const Point& x) { return 1 + x[0] - 2 * x[1] + x[2]; }),
            1e-12);
  EXPECT_LT(
      recovery_error(cube(3, 3, skewed),
                     [](const Point& x) { return 1 + x[0] * x[0] * x[1] - 2 * std::pow(x[1], 3) + x[2]; }),
      1e-11);
}

// One layer of cells has no interior corner: the patches of boundary corners take over.
TEST(PatchRecovery, SingleLayersFallBackToWhatTheirSamplesDetermine) {
  EXPECT_LT(recovery_error(cube(1, 2, skewed), [](const Point& x) { return 1 + x[0] - 2 * x[1] + x[2]; }),
            1e-12);
}

// A node takes its value from patches that hold it, on the body's edges and corners too: what one layer of
// cells has does not reach nodes beyond the next two layers, to which its patches extend.
TEST(PatchRecovery, WhatALayerOfCellsHasStaysBesideIt) {
  constexpr int n = 5;
  const auto grid = cube(n, 2, straight);
  for (const auto& free : {std::vector<fem::BoundaryFace>{}, grid.boundary}) {
    const auto samples = fem::make_samples(grid, free);
    fem::RowMajor values = fem::RowMajor::Zero(samples.cell.size(), 1), nodal(grid.n_nodes, 1);
    for (std::size_t s = 0; s < samples.cell.size(); ++s) values(s, 0) = samples.position(0, s) < 1.0 / n;
    fem::recover_by_patches(grid, fem::cells_of_nodes(grid), {}, samples, values, nodal);
    double within = 0, beyond = 0;
    for (std::size_t i = 0; i < grid.n_nodes; ++i) {
      const double x = grid.position(i)[0];
      (x > 2.0 / n + 1e-9 ? beyond : within) =
          std::max(x > 2.0 / n + 1e-9 ? beyond : within, std::abs(nodal(i, 0)));
    }
    EXPECT_GT(within, 0.5);
    EXPECT_EQ(beyond, 0);
  }
}

/// Largest nodal error of the stress of the interpolant of a smooth displacement.
double stress_error(int n, bool patches) {
  const auto grid = cube(n, 2, curved);
  const fem::Lame elastic{1, 1};
  const auto exact = [](const Point& x) {  // u = (sin(2x + y), cos(y + z), sin(x) cos(2 z))
    Eigen::Matrix3d g;
    g << 2 * std::cos(2 * x[0] + x[1]), std::cos(2 * x[0] + x[1]), 0, 0, -std::sin(x[1] + x[2]),
        -std::sin(x[1] + x[2]), std::cos(x[0]) * std::cos(2 * x[2]), 0,
        -2 * std::sin(x[0]) * std::sin(2 * x[2]);
    return Eigen::Matrix3d(g.trace() * Eigen::Matrix3d::Identity() + g + g.transpose());
  };
  fem::RowMajor u(grid.n_nodes, 3), stress(grid.n_nodes, 6);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const double* x = grid.position(i);
    u.row(i) << std::sin(2 * x[0] + x[1]), std::cos(x[1] + x[2]), std::sin(x[0]) * std::cos(2 * x[2]);
  }
  const auto cells = fem::cells_of_nodes(grid);
  if (patches)
    fem::recover_by_patches(grid, cells, {}, fem::make_samples(grid, {}),
                            fem::stress_at_samples(grid, {}, elastic, u), stress);
  else
    fem::average_stress(grid, cells, elastic, u, stress);
  double worst = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const Eigen::Matrix3d s = exact(Point(grid.position(i)));
    const std::array<double, 6> theirs = {{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)}};
    for (int c = 0; c < 6; ++c) worst = std::max(worst, std::abs(stress(i, c) - theirs[c]));
  }
  return worst;
}

// Cells' own stress at nodes converges with order 2; the sampling points have one order more, and the fits
// keep it.
TEST(PatchRecovery, SmoothFieldsConvergeOneOrderFasterThanAverages) {
  const double coarse = stress_error(4, true), fine = stress_error(8, true);
  const double coarse_average = stress_error(4, false), fine_average = stress_error(8, false);
  RecordProperty("patch", std::to_string(coarse) + " " + std::to_string(fine));
  RecordProperty("average", std::to_string(coarse_average) + " " + std::to_string(fine_average));
  EXPECT_LT(fine, fine_average);
  EXPECT_GT(std::log2(coarse / fine), 2.7);
  EXPECT_NEAR(std::log2(coarse_average / fine_average), 2, 0.4);
}

// In r, theta, z with the angle's sine and cosine: pull, torsion and bending of a shaft are of the harmonics
// 0 and 1, and linear in r. Around a curved surface 45 degrees wide, polynomials of x and y would not do.
TEST(PatchRecovery, BeamStressesAreExactInRoundPatches) {
  const auto rod = fem_tests::rod(8);
  const auto grid = fem::make_grid(rod.body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto field = [](const Point& x) {
    return std::array<double, 6>{{0, 0, 1 + 40 * x[0] - 30 * x[1], 0, 50 * x[0], -50 * x[1]}};
  };
  const auto samples = fem::make_samples(grid, {});
  fem::RowMajor values(samples.cell.size(), 6), nodal(grid.n_nodes, 6);
  for (std::size_t s = 0; s < samples.cell.size(); ++s)
    for (int c = 0; c < 6; ++c) values(s, c) = field(samples.position.col(s))[c];
  fem::recover_by_patches(grid, cells, rod.body.cylinders, samples, values, nodal);
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    for (int c = 0; c < 6; ++c)
      ASSERT_NEAR(nodal(i, c), field(Point(grid.position(i)))[c], 1e-11) << i << " " << c;
}

// Uniaxial tension along a skew direction, on faces parallel to it: the strains along the face give it back.
TEST(FreeFaces, CarryTheStressAlongThemAndNoneAcross) {
  const auto grid = cube(2, 2, straight);
  const fem::Lame elastic = fem::lame({200e9, 0.3, 1});
  fem::RowMajor u(grid.n_nodes, 3);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const double* x =
        grid.position(i);  // 1 MPa along x: strain and lateral contraction, and a rigid turn about z
    const double strain = 1e6 / 200e9;
    u.row(i) << strain * x[0] - 1e-3 * x[1], -0.3 * strain * x[1] + 1e-3 * x[0], -0.3 * strain * x[2];
  }
  std::vector<fem::BoundaryFace> along;
  for (const auto& face : grid.boundary)
    if (face.face >= 2) along.push_back(face);
  const auto at_faces = fem::stress_at_samples(grid, along, elastic, u).bottomRows(4 * along.size()).eval();
  for (Eigen::Index s = 0; s < at_faces.rows(); ++s)
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(at_faces(s, c), c == 0 ? 1e6 : 0, 1e-3);
}

}  // namespace
