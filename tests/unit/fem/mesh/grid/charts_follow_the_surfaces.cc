#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/charts.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

double distance(const fem::Coordinates& a, const fem::Coordinates& b) {
  return std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

TEST(Charts, EccentricCylinderForwardAndBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double inner = 0.1 * share(random), outer = inner + 0.01 + share(random);
    const double shift = 0.97 * (outer - inner) * share(random), direction = 7 * share(random);
    const fem::CylinderChart chart{1, shift * std::cos(direction), shift * std::sin(direction), inner, outer};
    const fem::Coordinates c = {1.2 * outer * share(random), 6.28 * share(random), share(random) - 0.5};
    const auto x = push_forward(chart, c);
    const auto back = pull_back(chart, x);
    EXPECT_NEAR(back[0], c[0], 1e-12);  // steep where the shift almost uses up the ring: 33 times rounding
    EXPECT_LT(distance(push_forward(chart, back), x), 1e-14);
  }
}

TEST(Charts, TheSeatOfAnEccentricCylinderIsRoundAboutItsOwnAxis) {
  const fem::CylinderChart chart{1, 0.004, -0.001, 0.02, 0.03};
  for (const double theta : {0.0, 1.0, 2.0, 4.0}) {
    const auto x = push_forward(chart, {0.03, theta, 0});
    EXPECT_NEAR(std::hypot(x[0] - 0.004, x[1] + 0.001), 0.03, 1e-16);
    const auto inside = push_forward(chart, {0.02, theta, 0});
    EXPECT_NEAR(std::hypot(inside[0], inside[1]), 0.02, 1e-16);
  }
}

TEST(Charts, TorusForwardAndBack) {
  const fem::TorusChart chart{1, 0.1, 0.05, 0.01};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const fem::Coordinates c = {0.001 + 0.04 * share(random), 6.28 * share(random), 6.28 * share(random)};
    EXPECT_LT(distance(pull_back(chart, push_forward(chart, c)), c), 1e-12);
  }
  const auto inner = push_forward(chart, {0.01, 0, 3.14159265358979323846});
  EXPECT_NEAR(inner[0], 0.04, 1e-15);  // angle pi points to the axis
  EXPECT_NEAR(push_forward(chart, {0.01, 0, 1.5 * 3.14159265358979323846})[2], 0.11, 1e-15);
}

struct Distances {
  double at_nodes = 0, between = 0;
};

/// Largest distance from a surface, given as a function of the point, over the faces of a group: at nodes and
/// between.
template <typename Distance>
Distances distances(const fem::Grid& grid, int boundary_id, const Distance& distance) {
  const auto at = fem::gauss_on_face(grid.shape(), 5);
  Distances d;
  for (const auto& face : grid.boundary) {
    if (face.boundary_id != boundary_id) continue;
    const auto nodes = fem::nodes_of_face(grid, face.cell, face.face);
    for (const auto node : nodes)
      d.at_nodes = std::max(d.at_nodes, distance(Eigen::Vector3d(grid.position(node))));
    for (int q = 0; q < at.n_points; ++q)
      d.between = std::max(d.between, distance(fem::face_point(grid, nodes, at, q).position));
  }
  return d;
}

// Also across the branch cut at theta = 0: a mean that went the long way round would put a node on the other
// side.
TEST(Charts, NodesLieOnSeatsAndFillets) {
  const auto shaft = fem_tests::eccentric_shaft();
  const auto grid = fem::make_grid(shaft.body);
  for (const auto& [name, port] : shaft.ports) {
    if (port.kind != fem::LoadSurface::Kind::seat) continue;
    const auto d = distances(grid, port.boundary_id, [&port = port](const Eigen::Vector3d& x) {
      return std::abs(std::hypot(x[0] - port.centre_m[0], x[1] - port.centre_m[1]) - port.radius_m);
    });
    EXPECT_LT(d.at_nodes, 1e-15 * 10) << name;
    EXPECT_LT(d.between, 2e-3 * port.radius_m) << name;  // parabolas over 45 degrees
    EXPECT_GT(d.between, 0);
  }
  for (const auto& torus : shaft.body.tori) {
    const auto d = distances(grid, torus.boundary_id, [&](const Eigen::Vector3d& x) {
      return std::abs(std::hypot(std::hypot(x[0], x[1]) - torus.centre_radius_m, x[2] - torus.centre_z_m) -
                      torus.radius_m);
    });
    EXPECT_LT(d.at_nodes, 1e-15 * 10);
    EXPECT_LT(d.between, 0.02 * torus.radius_m);
  }
}

// Cells on both sides of a face place its nodes at the same points: the sum of all faces' area vectors of the
// boundary vanishes only for a closed surface, and every cell's positions agree with the shared ones.
TEST(Charts, BoundaryIsClosed) {
  const auto grid = fem::make_grid(fem_tests::eccentric_shaft().body);
  const auto at = fem::gauss_on_face(grid.shape(), 4);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0, flux = 0;
  for (const auto& face : grid.boundary) {
    const auto nodes = fem::nodes_of_face(grid, face.cell, face.face);
    for (int q = 0; q < at.n_points; ++q) {
      const auto p = fem::face_point(grid, nodes, at, q);
      sum += p.area;
      area += p.area.norm();
      flux += p.position.dot(p.area) / 3;
    }
  }
  EXPECT_LT(sum.norm(), 1e-14 * area);
  const auto integrals = fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid)));
  EXPECT_NEAR(flux, integrals.col(0).sum(),
              1e-13 * flux);  // Gauss: normals point outwards, cells fit together
}

}  // namespace
