#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/equations/loads/nodal_loads.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

TEST(NodalLoads, CloseAndStandOnTheNodesOfTheResponses) {
  const auto rod = fem_tests::rod(8);
  const std::vector<fem::UnitLoad> loads = {fem_tests::resultant(rod, "end_1", Component::mx),
                                            fem_tests::resultant(rod, "rod", Component::fz)};
  const auto nodal = fem::nodal_loads(rod.body, loads);
  const auto responses = fem::Model(rod.body).unit_responses(loads, {});
  EXPECT_EQ(nodal.nodes.xyz_m, responses.nodes.xyz_m);
  EXPECT_EQ(nodal.nodes.cells, responses.nodes.cells);
  EXPECT_EQ(nodal.nodes.volume_m3, responses.nodes.volume_m3);
  const std::size_t n = nodal.nodes.n;
  ASSERT_EQ(nodal.force_N.size(), 2 * 3 * n);
  for (std::size_t k = 0; k < 2; ++k) {
    std::array<double, 6> sum{};
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double* f = &nodal.force_N[(k * n + i) * 3];
      const double* x = &nodal.nodes.xyz_m[3 * i];
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t e = (d + 1) % 3, g = (d + 2) % 3;
        sum[d] += f[d];
        sum[3 + d] += x[e] * f[g] - x[g] * f[e];
        largest = std::max(largest, std::abs(f[d]));
      }
    }
    EXPECT_GT(largest, 0);
    // Rounding of some thousand forces, moments about a point 0.2 m away.
    for (const double component : sum) EXPECT_NEAR(component, 0, 1e-12 * std::max(1.0, largest));
  }
}

TEST(NodalLoads, HoldSixDifferentUnknowns) {
  const auto rod = fem_tests::rod(8);
  const auto nodal = fem::nodal_loads(rod.body, {fem_tests::resultant(rod, "end_1", Component::fz)});
  for (std::size_t i = 1; i < 6; ++i) EXPECT_LT(nodal.held[i - 1], nodal.held[i]);
  EXPECT_LT(nodal.held[5], std::int64_t(3 * nodal.nodes.n));
}

TEST(NodalLoads, AreRefusedForABodyThatIsHeld) {
  auto rod = fem_tests::rod(8);
  const std::vector<fem::UnitLoad> loads = {fem_tests::resultant(rod, "end_1", Component::fz)};
  rod.body.clamps.push_back({rod.ports.at("end_2").boundary_id});
  EXPECT_THROW(fem::nodal_loads(rod.body, loads), std::invalid_argument);
  rod.body.clamps.clear();
  rod.body.elastic_supports.push_back({rod.ports.at("end_2"), {1e6, 0, 0}});
  EXPECT_THROW(fem::nodal_loads(rod.body, loads), std::invalid_argument);
}

}  // namespace
