#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/checks/quality.h"
#include "meshes/spacing/disc.h"
#include "meshes/spacing/grading.h"

namespace {

TEST(Grading, GeometricCellsStartAsWantedAndFillTheLength) {
  const auto x = meshes::geometric_fractions(4, 0.05);
  ASSERT_EQ(x.size(), 5u);
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 1);
  EXPECT_NEAR(x[1], 0.05, 1e-12);  // sixty bisections reach rounding
  const double ratio = (x[2] - x[1]) / x[1];
  for (int i = 2; i < 4; ++i) EXPECT_NEAR((x[i + 1] - x[i]) / (x[i] - x[i - 1]), ratio, 1e-9);
}

TEST(Grading, CellsNeverShrink) {
  const auto x = meshes::geometric_fractions(3, 0.9);
  EXPECT_NEAR(x[1], 1.0 / 3, 1e-15);
  EXPECT_NEAR(x[2], 2.0 / 3, 1e-15);
}

TEST(Grading, CountIsTheSmallestThatCovers) {
  EXPECT_EQ(meshes::geometric_count(1, 1, 2), 1);
  EXPECT_EQ(meshes::geometric_count(3, 1, 2), 2);
  EXPECT_EQ(meshes::geometric_count(3.01, 1, 2), 3);
}

TEST(Grading, StationsFollowTheWantedSize) {
  meshes::AxialSize size;
  size.sources = {{0, 0.01}};
  size.growth = 0.2;
  size.largest_m = 0.1;
  const auto z = meshes::axial_stations(0, 1, size, 1);
  EXPECT_EQ(z.front(), 0);
  EXPECT_EQ(z.back(), 1);
  for (std::size_t i = 1; i < z.size(); ++i) {
    const double wanted = size.at(0.5 * (z[i - 1] + z[i]));
    // The count is rounded to a whole number: with 17 cells that changes each by less than 1/17.
    EXPECT_NEAR((z[i] - z[i - 1]) / wanted, 1, 0.06);
  }
  EXPECT_EQ(meshes::axial_stations(0, 1, size, 40).size(), 41u);
}

TEST(Disc, FillsThePolygonWithConvexCells) {
  for (const int n : {8, 12, 16, 20, 24, 32, 64}) {
    const auto disc = meshes::build_disc(n);
    double area = 0, smallest_sine = 1;
    for (const auto& quad : disc.quads)
      for (int i = 0; i < 4; ++i) {
        const auto &p = disc.points[quad[i]], &next = disc.points[quad[(i + 1) % 4]],
                   &last = disc.points[quad[(i + 3) % 4]];
        area += 0.5 * (p[0] * next[1] - next[0] * p[1]);
        const double u[2] = {next[0] - p[0], next[1] - p[1]}, v[2] = {last[0] - p[0], last[1] - p[1]};
        smallest_sine = std::min(
            smallest_sine, (u[0] * v[1] - u[1] * v[0]) / (std::hypot(u[0], u[1]) * std::hypot(v[0], v[1])));
      }
    EXPECT_NEAR(area, 0.5 * n * std::sin(2 * std::acos(-1.0) / n), 1e-13) << n;  // sum of up to 1e3 cells
    EXPECT_GT(smallest_sine, 0.7) << n;  // three cells meet at a corner of the square: 135 degrees at worst
    EXPECT_EQ(disc.points[0][0], 1);
    EXPECT_EQ(disc.points[0][1], 0);
  }
}

meshes::HexMesh brick() {
  meshes::HexMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}};
  mesh.hexes = {{{0, 1, 2, 3, 4, 5, 6, 7}, 1}};
  return mesh;
}

TEST(ScaledJacobian, IsOneForABrickAndTheCosineForAShearedOne) {
  auto mesh = brick();
  EXPECT_NEAR(meshes::scaled_jacobian(mesh, mesh.hexes[0]), 1, 1e-15);
  for (int i = 4; i < 8; ++i) mesh.points[i][0] += 5;  // the long edges lean by 45 degrees
  EXPECT_NEAR(meshes::scaled_jacobian(mesh, mesh.hexes[0]), std::sqrt(0.5), 1e-15);
}

/// One corner pushed through: each corner has to be looked at.
TEST(ScaledJacobian, FindsAnyOneBadCorner) {
  for (int bad = 0; bad < 8; ++bad) {
    auto mesh = brick();
    auto& p = mesh.points[bad];
    const double centre[3] = {1, 1.5, 2.5};
    for (int c = 0; c < 3; ++c) p[c] += 1.5 * (centre[c] - p[c]);
    EXPECT_LT(meshes::scaled_jacobian(mesh, mesh.hexes[0]), 0) << bad;
  }
}

TEST(ScaledJacobian, ReportsThePlaceOfTheWorstCell) {
  auto mesh = brick();
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({mesh.points[i][0] + 10, mesh.points[i][1], mesh.points[i][2]});
  for (int i = 12; i < 16; ++i) mesh.points[i][1] += 5;
  mesh.hexes.push_back({{8, 9, 10, 11, 12, 13, 14, 15}, 1});
  const auto quality = meshes::measure_quality(mesh);
  EXPECT_EQ(quality.n_cells, 2u);
  EXPECT_EQ(quality.n_vertices, 16u);
  EXPECT_NEAR(quality.min_scaled_jacobian, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(quality.worst_x_m, 11, 1e-14);
  EXPECT_NEAR(quality.worst_y_m, 4, 1e-14);
  EXPECT_NEAR(quality.worst_z_m, 2.5, 1e-14);
}

}  // namespace
