/// From 27 nodes to the 20 of CalculiX's C3D20, on cells whose answers are in every textbook.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "fem/base/values/vtk_order.h"
#include "pipelines/command/calculix/calculix_model.h"

namespace {

using Point = std::array<double, 3>;

/// One or two unit cubes beside each other along x, in the order of the unit responses' cells.
fem::Nodes cubes(int n_cells) {
  fem::Nodes nodes;
  const int row = 2 * n_cells + 1;
  nodes.n = std::size_t(row) * 9;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < row; ++i)
        for (const int index : {i, j, k}) nodes.xyz_m.push_back(index / 2.0);
  for (int c = 0; c < n_cells; ++c)
    for (const int l : fem::vtk_hexahedron_from_lexicographic)
      nodes.cells.push_back(2 * c + l % 3 + row * (l / 3 % 3) + row * 3 * (l / 9));
  const double simpson[] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
  nodes.volume_m3.assign(nodes.n, 0.0);
  for (int c = 0; c < n_cells; ++c)
    for (int l = 0; l < 27; ++l) {
      const int node = 2 * c + l % 3 + row * (l / 3 % 3) + row * 3 * (l / 9);
      nodes.volume_m3[std::size_t(node)] += simpson[l % 3] * simpson[l / 3 % 3] * simpson[l / 9];
    }
  return nodes;
}

Point at(const fem::Nodes& nodes, std::size_t i) {
  return {nodes.xyz_m[3 * i], nodes.xyz_m[3 * i + 1], nodes.xyz_m[3 * i + 2]};
}

/// How many coordinates lie in the middle of the cube: 0 corner, 1 edge, 2 face, 3 cell.
int middles(const Point& x) {
  return int(std::count(x.begin(), x.end(), 0.5));
}

/// The monomials x^a y^b z^c of a cell of 20 nodes: squares of at most one coordinate.
std::vector<std::array<int, 3>> serendipity_monomials() {
  std::vector<std::array<int, 3>> result;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c)
        if ((a == 2) + (b == 2) + (c == 2) <= 1) result.push_back({a, b, c});
  return result;
}

double power(const Point& x, const std::array<int, 3>& degree) {
  return std::pow(x[0], degree[0]) * std::pow(x[1], degree[1]) * std::pow(x[2], degree[2]);
}

}  // namespace

TEST(Serendipity, TakesTheFieldsOfTwentyNodesAlongExactly) {
  const auto nodes = cubes(2);
  const pipelines::Serendipity kept(nodes);
  EXPECT_EQ(kept.n_kept(), 32u);
  const auto monomials = serendipity_monomials();
  ASSERT_EQ(monomials.size(), 20u);
  for (const auto& degree : monomials) {
    std::vector<double> values(nodes.n);
    for (std::size_t i = 0; i < nodes.n; ++i) values[i] = kept.keeps(i) ? power(at(nodes, i), degree) : 1e9;
    kept.extend(values.data(), 1);
    for (std::size_t i = 0; i < nodes.n; ++i)
      EXPECT_NEAR(values[i], power(at(nodes, i), degree), 1e-14)  // rounding of values up to 4
          << degree[0] << degree[1] << degree[2] << " at node " << i;
  }
}

// Body force: -1/8 at corners, 1/6 at edges. Pressure on a face: -1/12 at corners, 1/3 at edges.
TEST(Serendipity, CondensesToTheConsistentForcesOfTextbooks) {
  const auto nodes = cubes(1);
  const pipelines::Serendipity kept(nodes);
  auto body = nodes.volume_m3;
  kept.condense(body.data(), 1);
  std::vector<double> face(nodes.n, 0.0);
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (at(nodes, i)[0] == 1)
      face[i] = std::array<double, 3>{1 / 36.0, 4 / 36.0, 16 / 36.0}[std::size_t(middles(at(nodes, i)))];
  kept.condense(face.data(), 1);
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const int place = middles(at(nodes, i));
    EXPECT_NEAR(body[i], place == 0 ? -1 / 8.0 : place == 1 ? 1 / 6.0 : 0, 1e-15) << i;
    const double on_face = place == 0 ? -1 / 12.0 : place == 1 ? 1 / 3.0 : 0;
    EXPECT_NEAR(face[i], at(nodes, i)[0] == 1 ? on_face : 0, 1e-15) << i;
  }
}

// What f does on a field of the 20 nodes, it does after condensing; and any forces are closed, on bent cells
// too.
TEST(Serendipity, ForcesDoTheSameWorkAndClose) {
  fem::NodalLoads loads;
  loads.nodes = cubes(2);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (auto& x : loads.nodes.xyz_m) x += 0.05 * number(random);
  const pipelines::Serendipity kept(loads.nodes);
  std::vector<double> field(3 * loads.nodes.n), force(3 * loads.nodes.n);
  for (auto& u : field) u = number(random);
  kept.extend(field.data(), 3);
  for (auto& f : force) f = number(random);
  const double work = std::inner_product(force.begin(), force.end(), field.begin(), 0.0);
  auto condensed = force;
  kept.condense(condensed.data(), 3);
  EXPECT_NEAR(std::inner_product(condensed.begin(), condensed.end(), field.begin(), 0.0), work, 1e-13);

  loads.force_N = force;
  const auto closed = pipelines::calculix_forces(loads, kept);
  EXPECT_GT(closed.moment_removed, 1e-3);
  std::array<double, 6> resultant{};
  for (std::size_t i = 0; i < loads.nodes.n; ++i) {
    const auto x = at(loads.nodes, i);
    const double* f = &closed.force_N[3 * i];
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t e = (d + 1) % 3, g = (d + 2) % 3;
      resultant[d] += f[d];
      resultant[3 + d] += x[e] * f[g] - x[g] * f[e];
    }
    if (!kept.keeps(i)) {
      EXPECT_EQ(std::abs(f[0]) + std::abs(f[1]) + std::abs(f[2]), 0) << i;
    }
  }
  for (const double component : resultant) EXPECT_NEAR(component, 0, 1e-13);  // rounding of 45 forces of 1 N
}
