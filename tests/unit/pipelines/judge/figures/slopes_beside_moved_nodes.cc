/// The slope of stress below a surface of revolution, some of whose nodes were moved to the crest between
/// half planes.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/judge/figures/stress_gradient.h"

using namespace pipelines;

namespace {

constexpr int n_angles = 24, n_radii = 3, n_heights = 3;
constexpr double radius_m = 0.0175, cell_m = 5e-5, gradient_per_m = 2500;

std::size_t node_at(int height, int depth, int angle) {
  return std::size_t((height * n_radii + depth) * n_angles + (angle + n_angles) % n_angles);
}

/// Straight cells below the surface of a shaft, much longer around it than they are deep, as beside a fillet.
fem::Nodes ring_of_cells() {
  fem::Nodes nodes;
  nodes.degree = 1;
  nodes.n = std::size_t(n_angles * n_radii * n_heights);
  for (int height = 0; height < n_heights; ++height)
    for (int depth = 0; depth < n_radii; ++depth)
      for (int j = 0; j < n_angles; ++j) {
        const double r = radius_m - depth * cell_m, angle = 2 * M_PI * j / n_angles;
        nodes.xyz_m.insert(nodes.xyz_m.end(), {r * std::cos(angle), r * std::sin(angle), height * cell_m});
      }
  for (int height = 0; height + 1 < n_heights; ++height)
    for (int j = 0; j < n_angles; ++j) {
      for (int depth = 0; depth + 1 < n_radii; ++depth)
        for (const int up : {0, 1})
          for (const auto& [in, around] : {std::pair{1, 0}, {0, 0}, {0, 1}, {1, 1}})
            nodes.cells.push_back(std::int32_t(node_at(height + up, depth + in, j + around)));
      for (const auto& [up, around] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}})
        nodes.faces.push_back(std::int32_t(node_at(height + up, 0, j + around)));
      nodes.face_boundary_id.push_back(0);
    }
  return nodes;
}

double radius_in_cells(const fem::Nodes& nodes, std::size_t node) {
  return std::hypot(nodes.xyz_m[3 * node], nodes.xyz_m[3 * node + 1]);
}

}  // namespace

// A field that falls below the surface by the same share everywhere has one gradient at every node, moved or
// not. Turns red: cells whose corner has gone some way around the axis; they are slivers, and the slope at
// the nodes beside was a hundred times the right one, of either sign.
TEST(SurfaceSlopes, DoNotDependOnNodesThatWereMovedAround) {
  auto nodes = ring_of_cells();
  const auto moved = node_at(1, 0, 0);
  nodes.moved_from_m[moved] = {nodes.xyz_m[3 * moved], nodes.xyz_m[3 * moved + 1],
                               nodes.xyz_m[3 * moved + 2]};
  const double angle = 0.45 * 2 * M_PI / n_angles;
  nodes.xyz_m[3 * moved] = radius_m * std::cos(angle);
  nodes.xyz_m[3 * moved + 1] = radius_m * std::sin(angle);
  const SurfaceSlopes slopes(nodes);
  const auto field = [&](std::size_t node) {
    return 1 - gradient_per_m * (radius_m - radius_in_cells(nodes, node));
  };
  for (int height = 0; height < n_heights; ++height)
    for (const int j : {-1, 0, 1}) {
      const auto node = node_at(height, 0, j);
      EXPECT_NEAR(slopes.related_gradient_per_m(node, field), gradient_per_m, 0.01 * gradient_per_m)
          << height << ' ' << j;
    }
}
