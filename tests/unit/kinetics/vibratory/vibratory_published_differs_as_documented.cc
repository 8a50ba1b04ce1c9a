#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::Vector2d;
using kinetics::Convention;
using kinetics::LoadHistory;
using kinetics::VibratoryMill;
using machines::effects_without;
using machines::largest;

Array2Xd reaction(const LoadHistory& loads) {
  return loads.resultant("frame_bearings").total.topRows<2>();
}

Array2Xd along(const ArrayXd& angle) {
  Array2Xd e(2, angle.size());
  e.row(0) = angle.cos().transpose();
  e.row(1) = -angle.sin().transpose();
  return e;
}

}  // namespace

// Errata 1 and 2 are the whole difference of R_E without preload, lateral stiffness, damping and pitch.
TEST(VibratoryPublished, LacksCentripetalTermAndCarriedMasses) {
  std::mt19937 generator(3);
  for (int k = 0; k < 20; ++k) {
    VibratoryMill mill = machines::random(generator);
    for (auto& spring : mill.springs) {
      spring.preload_N = Vector2d::Zero();
      spring.stiffness_N_m.x() = 0;
    }
    mill.springs = {mill.springs[0], mill.springs[mill.springs.size() > 1 ? 1 : 0]};
    const auto consistent = compute_loads(
        mill, effects_without(mill, {"pitch", "charge_follows_pitch", "charge_lag", "spring_damping"}),
        {2, 30});
    mill.convention = Convention::published;
    const auto published = compute_loads(mill, effects_without(mill, {}), {2, 30});
    const double w2 = mill.speed_rad_s * mill.speed_rad_s;
    const Array2Xd missing =
        -(mill.charge_mass_kg * mill.charge_offset_m * w2 * along(consistent.quantity("chi").values) +
          (mill.structure_mass_kg + mill.exciter_mass_kg) * w2 * mill.eccentricity_m *
              along(consistent.phi_rad));
    double scale = 0;  // of the largest force that enters: they cancel
    for (const auto& part : consistent.resultant("frame_bearings").contributions)
      scale = std::max(scale, part.load.abs().maxCoeff());
    EXPECT_LE((reaction(consistent) - reaction(published) - missing).abs().maxCoeff(), 1e-13 * scale);
  }
}

TEST(VibratoryPublished, DeliversTheLoadStageOnly) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  const auto loads = compute_loads(mill, effects_without(mill, {}), {1, 36});
  EXPECT_EQ(loads.convention, "published");
  ASSERT_EQ(loads.resultants.size(), 1u);
  EXPECT_EQ(loads.resultants[0].role, "frame_bearings");
  const ArrayXd from_shares = loads.resultants[0].total.topRows<2>().matrix().colwise().norm().transpose();
  EXPECT_LE(largest(from_shares - loads.quantity("R_E").values), 1e-15 * largest(from_shares));
}

// K* has poles where sin(phi) = 0: the value there is finite, lies between the neighbours' opposite excesses,
// and the quantity says that its extremes mean nothing.
TEST(VibratoryPublished, StiffnessFromMomentsIsFiniteAtItsPoles) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  const auto loads = compute_loads(mill, effects_without(mill, {}), {3, 72});
  const auto& k_star = loads.quantity("K_star");
  EXPECT_FALSE(k_star.has_statistics);
  EXPECT_TRUE(loads.quantity("spring_force").has_statistics);
  ASSERT_TRUE(k_star.values.allFinite());
  for (const Eigen::Index pole : {36, 72, 108, 144, 180}) {
    // (F(h) - F(-h)) / (2 ecc sin h) at the grid's own step of 5 degrees: central differences, here good to a
    // per cent of the neighbours.
    const double mean = (k_star.values[pole - 1] + k_star.values[pole + 1]) / 2;
    EXPECT_NEAR(k_star.values[pole], mean, 0.01 * std::abs(k_star.values[pole - 1])) << pole;
    EXPECT_LT(k_star.values[pole - 1] * k_star.values[pole + 1], 0) << "no pole";
  }
}

// The structure's weight alone makes F* = 2 m1 g LE / (QE + HE) constant: K* is then odd about its poles, and
// its principal value there is zero.
TEST(VibratoryPublished, PrincipalValueIsZeroForAConstantForce) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  const auto loads = compute_loads(mill, {"springs", "gravity_structure"}, {1, 8});
  const double force = 2 * 30 * 9.81 * 0.26 / 0.56;
  EXPECT_LE(largest(loads.quantity("spring_force_from_moments").values - force), 1e-12 * force);
  // +F / (ecc sin h) and -F / (ecc sin h), h = 1e-3: they cancel to round-off of phi (1e-16 / h) times their
  // size.
  EXPECT_NEAR(loads.quantity("K_star").values[4], 0, 1e-11 * force / (0.004 * 1e-3));
}

TEST(VibratoryPublished, NoEccentricityLeavesTheStiffnessOut) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  mill.eccentricity_m = 0;
  const auto loads = compute_loads(mill, effects_without(mill, {}), {20, 36});
  EXPECT_THROW(loads.quantity("K_star"), std::out_of_range);
  ASSERT_EQ(loads.warnings.size(), 1u);
  EXPECT_NE(loads.warnings[0].find("K_star"), std::string::npos);
}

TEST(VibratoryPublished, WithoutSpringsTheirNumberIsFree) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  mill.springs.clear();
  const auto loads = compute_loads(mill, effects_without(mill, {"springs"}), {1, 36});
  EXPECT_THROW(loads.quantity("spring_force_from_moments"), std::out_of_range);
}
