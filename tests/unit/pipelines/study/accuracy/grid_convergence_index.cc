#include "pipelines/study/accuracy/grid_convergence.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pipelines;

namespace {

/// f + c h^p on meshes of the given cell sizes.
std::vector<MeshValue> series(double limit, double coefficient, double order,
                              const std::vector<double>& sizes) {
  std::vector<MeshValue> meshes;
  for (const double size : sizes) meshes.push_back({size, limit + coefficient * std::pow(size, order)});
  return meshes;
}

}  // namespace

// NASA Glenn, Examining Spatial (Grid) Convergence: pressure recovery of a supersonic inlet, grids halved
// twice. Printed: p 1.786170, 0.97130 at zero spacing, GCI_12 0.103083 %, GCI_23 0.356249 %, their ratio
// about 1 (1.002).
TEST(GridConvergence, InletOfNasasExample) {
  const auto c = grid_convergence({{4, 0.96178}, {2, 0.96854}, {1, 0.97050}}, 2);
  ASSERT_TRUE(c.usable()) << c.refusal;
  EXPECT_EQ(c.safety, 1.25);
  EXPECT_NEAR(c.observed_order, 1.786170, 1e-6);             // last printed digit
  EXPECT_NEAR(c.extrapolated, 0.97130, 5e-6);                // likewise
  EXPECT_NEAR(c.index_21 / 0.97050, 0.00103083, 5e-9);       // likewise
  EXPECT_NEAR(c.index_32 / 0.96854, 0.00356249, 5e-9);       // likewise
  EXPECT_NEAR(c.asymptotic_ratio, 0.97050 / 0.96854, 1e-9);  // what it comes to with the order that fits
}

// Celik et al. (2008), Table 1, first column: 18000, 8000 and 4500 cells of a plane flow, unequal ratios 1.5
// and 1.333. Printed: p 1.53, extrapolated 6.1685, GCI 2.2 %.
TEST(GridConvergence, ReattachmentLengthOfCelikAndOthers) {
  const auto c = grid_convergence(
      {{1 / std::sqrt(4500.), 5.863}, {1 / std::sqrt(8000.), 5.972}, {1 / std::sqrt(18000.), 6.063}}, 2);
  ASSERT_TRUE(c.usable()) << c.refusal;
  EXPECT_NEAR(c.ratio_21, 1.5, 1e-12);
  EXPECT_NEAR(c.ratio_32, 4. / 3, 1e-12);
  EXPECT_NEAR(c.observed_order, 1.53, 5e-3);  // printed digits, also below
  EXPECT_NEAR(c.extrapolated, 6.1685, 5e-5);
  EXPECT_NEAR(c.index_21 / 6.063, 0.022, 5e-4);
}

// A pure power: its order and its limit come back whatever the ratios, and the index is 1.25 times the true
// error.
TEST(GridConvergence, OrderAndLimitOfAPowerComeBack) {
  for (const double order : {0.7, 1.0, 2.0, 3.4})
    for (const auto& sizes : {std::vector<double>{4, 2, 1}, {3, 1.5, 1}, {2, 1.5, 1}, {1.3, 1.1, 1}})
      for (const double sign : {-1., 1.}) {
        const auto meshes = series(100, sign * 0.1, order, sizes);
        const auto c = grid_convergence(meshes, 4);
        ASSERT_TRUE(c.usable()) << order << c.refusal;
        // Rounding: changes of 1e-2 of values of 1e2, 1e-12 of them.
        EXPECT_NEAR(c.observed_order, order, 1e-8);
        EXPECT_NEAR(c.extrapolated, 100, 1e-8);
        EXPECT_NEAR(c.index_21, 1.25 * 0.1, 1e-8);
      }
}

// An order above the formal one is not believed: the index takes the formal one and becomes larger.
TEST(GridConvergence, NoMoreThanTheFormalOrderIsBelieved) {
  const auto meshes = series(100, 0.1, 3, {4, 2, 1});
  const auto c = grid_convergence(meshes, 2);
  ASSERT_TRUE(c.usable()) << c.refusal;
  EXPECT_NEAR(c.observed_order, 3, 1e-9);  // rounding
  EXPECT_EQ(c.order, 2);
  EXPECT_NEAR(c.index_21, 1.25 * 0.7 / 3, 1e-9);  // change 0.1 (2^3 - 1), over 2^2 - 1
}

TEST(GridConvergence, TwoMeshesAreBelievedThreeTimesLess) {
  const auto c = grid_convergence({{2, 98}, {1, 99.5}}, 2);
  ASSERT_TRUE(c.usable());
  EXPECT_EQ(c.safety, 3);
  EXPECT_EQ(c.observed_order, 0);
  EXPECT_NEAR(c.extrapolated, 100, 1e-12);  // 99.5 + 1.5 / 3
  EXPECT_NEAR(c.index_21, 1.5, 1e-12);
}

TEST(GridConvergence, OutsideTheAsymptoticRangeItIsRefused) {
  const auto refusal = [](const std::vector<MeshValue>& meshes) {
    return grid_convergence(meshes, 2).refusal;
  };
  EXPECT_NE(refusal({{4, 100}, {2, 103}, {1, 102}}).find("one direction"), std::string::npos);
  EXPECT_NE(refusal({{4, 100}, {2, 103}, {1, 103}}).find("one direction"), std::string::npos);
  EXPECT_NE(refusal({{4, 100}, {2, 101}, {1, 102}}).find("singular"), std::string::npos);     // order 0
  EXPECT_NE(refusal({{4, 100}, {2, 110}, {1, 123}}).find("singular"), std::string::npos);     // grows
  EXPECT_NE(refusal({{4, 90}, {2, 101}, {1, 101.01}}).find("by chance"), std::string::npos);  // order 10
  EXPECT_NE(refusal({{4, 30}, {2, 80}, {1, 100}}).find("not about 1"), std::string::npos);
  EXPECT_EQ(refusal({{4, 90}, {2, 97.6}, {1, 99.5}}), "");
}

TEST(GridConvergence, NothingChangesNothingIsMissing) {
  const auto c = grid_convergence({{4, 7}, {2, 7}, {1, 7 * (1 + 1e-13)}}, 2);
  EXPECT_TRUE(c.usable());
  EXPECT_EQ(c.index_21, 0);
}

TEST(GridConvergence, MeshesComeFromCoarseToFine) {
  EXPECT_THROW(grid_convergence({{1, 7}}, 2), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{1, 7}, {2, 8}}, 2), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{1.04, 7}, {1, 8}}, 2), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{2, 7}, {1, 8}}, 0), std::invalid_argument);
  EXPECT_THROW(grid_convergence({{2, 7}, {1, 8}, {0, 8}}, 2), std::invalid_argument);
}
