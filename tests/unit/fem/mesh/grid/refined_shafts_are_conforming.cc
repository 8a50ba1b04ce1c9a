// Shafts whose cells are cut at random, some several times: nodes hang, geometry and displacement stay
// continuous.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/stress/recovery/stress_recovery.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Point = Eigen::Vector3d;

fem::Grid refined_shaft(int n_cycles, unsigned seed, int degree = 2) {
  const double share = degree == 2 ? 0.05 : 0.01;
  auto body = fem_tests::eccentric_shaft(2).body;
  body.degree = degree;
  return fem::make_grid(fem_tests::refined_at_random(body, n_cycles, share, seed));
}

TEST(RefinedShafts, HangOnNodesThatDoNotHang) {
  const auto grid = refined_shaft(3, 1);
  const auto& hanging = grid.hanging;
  ASSERT_GT(hanging.n(), 1000u);
  std::vector<char> hangs(grid.n_nodes, 0);
  for (const auto node : hanging.node) hangs[std::size_t(node)] = 1;
  for (std::size_t i = 0; i < hanging.n(); ++i) {
    double sum = 0;
    Point place = Point::Zero();
    for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k) {
      EXPECT_EQ(hangs[std::size_t(hanging.master[k])], 0);
      sum += hanging.weight[k];
      place += hanging.weight[k] * Point(grid.position(hanging.master[k]));
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT((place - Point(grid.position(hanging.node[i]))).norm(), 1e-15);
  }
  // No two nodes at one place: vertices in the middle of larger edges are the nodes there.
  std::map<std::array<long, 3>, int> places;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const double* x = grid.position(std::int32_t(i));
    EXPECT_EQ(++places[(std::array<long, 3>{std::lround(x[0] * 1e9), std::lround(x[1] * 1e9),
                                            std::lround(x[2] * 1e9)})],
              1);
  }
}

// The energy of a rigid rotation was 4e-4 of that of a unit strain in a prototype whose hanging nodes kept
// their places on the true surface.
TEST(RefinedShafts, MoveRigidlyWithoutForce) {
  for (const int degree : {2, 3})
    for (unsigned seed = 1; seed <= (degree == 2 ? 4u : 1u); ++seed) {
      const auto grid = refined_shaft(2, seed, degree);
      const Eigen::MatrixXd rigid = fem::rigid_modes(grid, Point::Zero());
      const Eigen::MatrixXd strain = [&] {
        Eigen::MatrixXd u = Eigen::MatrixXd::Zero(rigid.rows(), 1);
        for (std::size_t i = 0; i < grid.n_nodes; ++i)
          u(3 * Eigen::Index(i), 0) = grid.position(std::int32_t(i))[1];
        return u;
      }();
      const double scale = fem_tests::stiffness_times(grid, strain).norm();
      const Eigen::MatrixXd force = fem_tests::stiffness_times(grid, rigid);
      for (int mode = 3; mode < 6; ++mode) EXPECT_LT(force.col(mode).norm(), 1e-12 * scale) << degree << mode;
    }
}

TEST(RefinedShafts, PassThePatchTest) {
  const auto grid = refined_shaft(2, 7);
  Eigen::MatrixXd u(3 * Eigen::Index(grid.n_nodes), 1);
  Eigen::Matrix3d gradient;
  gradient << 1, 0.3, -0.2, 0.7, -0.4, 0.1, -0.5, 0.6, 0.8;
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    u.middleRows<3>(3 * Eigen::Index(i)) = gradient * Point(grid.position(std::int32_t(i)));
  Eigen::MatrixXd force = fem_tests::stiffness_times(grid, u);
  const double scale = force.norm();
  for (const auto& face : grid.boundary)
    for (const int i : fem::face_nodes(grid.shape(), face.face))
      force.middleRows<3>(3 * Eigen::Index(grid.nodes_of(std::size_t(face.cell))[i])).setZero();
  EXPECT_LT(force.norm(), 1e-12 * scale);
}

TEST(RefinedShafts, RecoverQuadraticFieldsExactly) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto grid = refined_shaft(2, seed);
    const auto field = [](const Point& x) {
      const Point s = x / 0.06;
      return 1 + s[0] - 2 * s[1] * s[1] + 3 * s[0] * s[1] - s[2] * s[2] + s[1] * s[2];
    };
    const auto cells = fem::cells_of_nodes(grid);
    for (const auto& free : {std::vector<fem::BoundaryFace>{}, grid.boundary}) {
      const auto samples = fem::make_samples(grid, free);
      fem::RowMajor values(samples.cell.size(), 1), nodal(grid.n_nodes, 1);
      for (std::size_t s = 0; s < samples.cell.size(); ++s) values(s, 0) = field(samples.position.col(s));
      fem::recover_by_patches(grid, cells, {}, samples, values, nodal);
      double worst = 0, size = 0;
      for (std::size_t i = 0; i < grid.n_nodes; ++i) {
        worst = std::max(worst, std::abs(nodal(i, 0) - field(Point(grid.position(std::int32_t(i))))));
        size = std::max(size, std::abs(nodal(i, 0)));
      }
      EXPECT_LT(worst, 1e-10 * size) << seed;
    }
  }
}

// A finer space has lower frequencies, by less than the coarse one is off.
TEST(RefinedShafts, VibrateAsTheCoarseOnes) {
  const auto body = fem_tests::rod(8).body;
  const auto coarse = fem::Model(body).natural_frequencies(3);
  const auto fine = fem::Model(fem_tests::refined_at_random(body, 1, 0.1, 3)).natural_frequencies(3);
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const double ratio = fine[mode].frequency_Hz / coarse[mode].frequency_Hz;
    EXPECT_LT(ratio, 1 + 1e-6) << mode;
    EXPECT_GT(ratio, 0.99) << mode;
  }
}

// In one cycle a cell is cut, then its piece at the point, and the neighbours there once.
TEST(RefinedShafts, AreCutTwiceAtAPoint) {
  auto body = fem_tests::eccentric_shaft(2).body;
  const auto before = fem::make_grid(body);
  const auto corner = before.cell_nodes[0];
  const double* at_m = before.position(corner);
  const auto n_neighbours =
      std::size_t(std::count(before.cell_nodes.begin(), before.cell_nodes.end(), corner)) - 1;
  body.refinements = {{{0}}};
  EXPECT_EQ(fem::make_grid(body).n_cells(), before.n_cells() + 7);
  body.refinements = {{{0}, {{at_m[0], at_m[1], at_m[2]}}}};
  EXPECT_EQ(fem::make_grid(body).n_cells(), before.n_cells() + 7 * (2 + n_neighbours));
  const double* opposite_m = before.position(before.cell_nodes[before.nodes_per_cell() - 1]);
  std::array<double, 3>
      near_m{};  // a tenth of the cell inwards: the node of a cubic cell, or of a hanging face
  for (std::size_t d = 0; d < 3; ++d) near_m[d] = at_m[d] + 0.1 * (opposite_m[d] - at_m[d]);
  body.refinements = {{{0}, {near_m}}};
  EXPECT_EQ(fem::make_grid(body).n_cells(), before.n_cells() + 7 * (2 + n_neighbours));
  body.refinements = {{{0}, {{1e3, 0, 0}}}};
  EXPECT_THROW(fem::make_grid(body), std::invalid_argument);
}

TEST(RefinedShafts, RefuseCellsThatAreNot) {
  auto body = fem_tests::eccentric_shaft(2).body;
  body.refinements = {{{-1}}};
  EXPECT_THROW(fem::make_grid(body), std::invalid_argument);
  body.refinements = {{{1 << 30}}};
  EXPECT_THROW(fem::make_grid(body), std::invalid_argument);
  body.refinements = {{{0}}};
  body.degree = 1;
  EXPECT_THROW(fem::make_grid(body), std::invalid_argument);
}

}  // namespace
