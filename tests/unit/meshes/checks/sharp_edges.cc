#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

/// A closed circle about z of at least n_sectors straight pieces with their ends on it.
void expect_circle(const meshes::SharpEdge& edge, double z_m, double radius_m, std::size_t n_sectors) {
  SCOPED_TRACE(edge.name);
  ASSERT_GE(edge.pieces.size(), n_sectors);
  double turned = 0;
  for (std::size_t i = 0; i < edge.pieces.size(); ++i) {
    const auto& [from, to] = edge.pieces[i];
    EXPECT_EQ(to, edge.pieces[(i + 1) % edge.pieces.size()][0]);
    EXPECT_NEAR(std::hypot(from[0], from[1]), radius_m, 1e-15);
    EXPECT_EQ(from[2], z_m);
    turned += std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
  }
  EXPECT_NEAR(turned, 2 * std::acos(-1.0), 1e-12);
}

TEST(SharpEdges, AreTheSharpShoulders) {
  EXPECT_TRUE(meshes::build_shaft(laboratory_shaft(), {}).sharp_edges.empty());
  const auto body = meshes::build_shaft(sharp_eccentric_shaft(), {});
  ASSERT_EQ(body.sharp_edges.size(), 2u);
  EXPECT_EQ(body.sharp_edges[0].name, "left/disc");
  EXPECT_DOUBLE_EQ(body.sharp_edges[0].distance_m, 0.004);  // a tenth of 40 mm
  expect_circle(body.sharp_edges[0], 0.1, 0.02, 16);
  EXPECT_EQ(body.sharp_edges[1].name, "disc/right");
  EXPECT_DOUBLE_EQ(body.sharp_edges[1].distance_m, 0.003);
  expect_circle(body.sharp_edges[1], 0.15, 0.015, 16);
}

/// Of points on the circle from the nearest piece.
double farthest_m(const meshes::SharpEdge& edge, double z_m, double radius_m) {
  double farthest = 0;
  for (int j = 0; j < 720; ++j) {
    const double angle = 2 * std::acos(-1.0) * j / 720;
    const double p[] = {radius_m * std::cos(angle), radius_m * std::sin(angle), z_m};
    double nearest = 1;
    for (const auto& [from, to] : edge.pieces) {
      double along = 0, length = 0, distance = 0;
      for (int d = 0; d < 3; ++d) {
        along += (p[d] - from[d]) * (to[d] - from[d]);
        length += (to[d] - from[d]) * (to[d] - from[d]);
      }
      const double share = std::min(1.0, std::max(0.0, along / length));
      for (int d = 0; d < 3; ++d) {
        const double off = p[d] - from[d] - share * (to[d] - from[d]);
        distance += off * off;
      }
      nearest = std::min(nearest, std::sqrt(distance));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

// Cells around are few: chords of eight run up to 7.6 mm inside a drum's circle of 100 mm, of which 8 mm are
// left out. An octagon there let the corner itself be the peak, midway between its ends, and grow without
// bound.
TEST(SharpEdges, AreCirclesHoweverFewCellsAreAround) {
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  const auto drum = meshes::build_shaft(planetary_drum(), control);
  ASSERT_EQ(drum.sharp_edges.size(), 2u);
  for (const auto& edge : drum.sharp_edges)
    EXPECT_LT(farthest_m(edge, edge.pieces[0][0][2], 0.1), 1e-3 * edge.distance_m) << edge.name;
  const auto shaft = meshes::build_shaft(sharp_eccentric_shaft(), control);
  ASSERT_EQ(shaft.sharp_edges.size(), 2u);
  EXPECT_LT(farthest_m(shaft.sharp_edges[0], 0.1, 0.02), 1e-3 * shaft.sharp_edges[0].distance_m);
}

TEST(SharpEdges, AreTheBoreStepsWithinTheThicknessOfTheWall) {
  meshes::ShaftMeshControl control;
  control.n_sectors = 24;
  const auto drum = meshes::build_shaft(planetary_drum(), control);
  ASSERT_EQ(drum.sharp_edges.size(), 2u);
  EXPECT_EQ(drum.sharp_edges[0].name, "bore cover_1/shell");
  EXPECT_NEAR(drum.sharp_edges[0].distance_m, 0.008, 1e-15);
  expect_circle(drum.sharp_edges[0], drum.sharp_edges[0].pieces[0][0][2], 0.1, 24);
  EXPECT_NEAR(drum.sharp_edges[0].pieces[0][0][2], -0.5, 1e-15);
  EXPECT_EQ(drum.sharp_edges[1].name, "bore shell/cover_2");

  const auto flanged = meshes::build_shaft(stepped_bores()[1], control);
  ASSERT_EQ(flanged.sharp_edges.size(), 2u);  // inside and outside at one plane
  EXPECT_EQ(flanged.sharp_edges[0].name, "pipe/thick");
  EXPECT_DOUBLE_EQ(flanged.sharp_edges[0].distance_m, 0.008);
  expect_circle(flanged.sharp_edges[0], 0.1, 0.04, 24);
  EXPECT_EQ(flanged.sharp_edges[1].name, "bore pipe/thick");
  EXPECT_NEAR(flanged.sharp_edges[1].distance_m, 0.010, 1e-15);
  expect_circle(flanged.sharp_edges[1], 0.1, 0.03, 24);
}

}  // namespace
