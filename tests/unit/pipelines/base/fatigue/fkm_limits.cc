/// FKM: Haigh diagram, support and roughness factors, design factor, safety factors, by hand.
/// Turns red: a field's border shifted, M instead of M/3, gradient in 1/m, K_f~ in the wrong place.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "pipelines/base/fatigue/endurance.h"

namespace {

using namespace pipelines;

FatigueMaterial steel_800() {
  return {MaterialGroup::steel, 800e6, 600e6, 0.15};
}

TEST(FkmHaigh, ByHandWithM02) {
  const auto K = [](double mean) { return haigh_factor({1, mean}, 0.2); };
  EXPECT_NEAR(K(0), 1, 1e-15);
  EXPECT_NEAR(K(-5), 1 / 0.8, 1e-15);
  EXPECT_NEAR(K(0.5), 1 / 1.1, 1e-15);
  EXPECT_NEAR(K(2), (1 + 0.2 / 3) / 1.2 / (1 + 0.4 / 3), 1e-15);
  EXPECT_NEAR(K(9), 3.2 / (3 * 1.44), 1e-15);
  for (const double border : {-1.0, 1.0, 3.0})
    EXPECT_NEAR(K(border - 1e-9), K(border + 1e-9), 1e-9) << border;
  EXPECT_EQ(haigh_field({1, 0.999}), HaighField::alternating);
  EXPECT_EQ(haigh_field({1, 3}), HaighField::high_static_tension);
  EXPECT_EQ(equivalent_reversed_amplitude_Pa({100, 100}, 0.2), 100 * 1.2);  // R = 0: that is what M means
  EXPECT_THROW(haigh_factor({1, 0}, 1), std::invalid_argument);
}

TEST(FkmHaigh, SensitivityOfSteel) {
  EXPECT_NEAR(mean_stress_sensitivity(800e6, 0.35, -0.1), 0.18, 1e-15);
  EXPECT_NEAR(mean_stress_sensitivity(800e6, 0.35, -0.1, 0.577), 0.577 * 0.18, 1e-15);
  EXPECT_EQ(mean_stress_sensitivity(200e6, 0.35, -0.1), 0);
  EXPECT_EQ(mean_stress_sensitivity(250e6, 0, 0.5), 0.5);
}

TEST(FkmLimit, SupportOfThreeRanges) {
  const auto n = [](double per_mm) { return support_factor(steel_800(), StressKind::normal, per_mm * 1e3); };
  const double e = 0.5 + 800.0 / 2700;
  EXPECT_EQ(n(0), 1);
  EXPECT_NEAR(n(0.05), 1 + 0.05 * std::pow(10, 0.5 - e), 1e-14);
  EXPECT_NEAR(n(0.5), 1 + std::sqrt(0.5) * std::pow(10, -e), 1e-14);
  EXPECT_NEAR(n(16), 1 + 2 * std::pow(10, -e), 1e-14);
  for (const double border : {0.1, 1.0}) EXPECT_NEAR(n(border * (1 - 1e-9)), n(border * (1 + 1e-9)), 1e-9);
  EXPECT_EQ(n(1e4), n(100));
  EXPECT_NEAR(support_factor(steel_800(), StressKind::shear, 500),
              1 + std::sqrt(0.5) * std::pow(10, -(0.5 + 0.577 * 800 / 2700)), 1e-14);
  EXPECT_THROW(support_factor(steel_800(), StressKind::normal, -1), std::invalid_argument);
}

// Example of quadco.engineering's formula: 1 - 0.22 lg 100 lg 4 for R_m = 800 of steel.
TEST(FkmLimit, WholeChainByHand) {
  SurfaceState surface;
  surface.roughness_m = 100e-6;
  const auto limit = endurance_limit(steel_800(), StressKind::normal, 500, surface, {100e6, 100e6}, 1.5);
  const double K_R = 1 - 0.22 * 2 * std::log10(4.0),
               n = 1 + std::sqrt(0.5) * std::pow(10, -(0.5 + 800.0 / 2700));
  const double K_WK = (1 + 0.5 * (1 / K_R - 1)) / n;
  EXPECT_NEAR(limit.roughness, K_R, 1e-14);
  EXPECT_NEAR(limit.design_factor, K_WK, 1e-14);
  EXPECT_NEAR(limit.reversed_Pa, 0.45 * 800e6 / K_WK, 1e-5);
  EXPECT_NEAR(limit.amplitude_Pa, 0.45 * 800e6 / K_WK / 1.18, 1e-5);
  EXPECT_NEAR(limit.utilisation, 150e6 / limit.amplitude_Pa, 1e-14);
  surface.roughness_m = 0.5e-6;
  const auto smooth = endurance_limit(steel_800(), StressKind::shear, 0, surface, {1, -1}, 1);
  EXPECT_NEAR(smooth.amplitude_Pa, 0.577 * 0.45 * 800e6 / (1 + 0.577 * 0.18),
              1e-4);  // the sign of shear means nothing
  surface.roughness_m = 0.1;
  EXPECT_THROW(roughness_factor(steel_800(), StressKind::normal, surface.roughness_m), std::invalid_argument);
}

// Published table, its products rounded to 0.05 or 0.1.
TEST(FkmLimit, SafetyFactors) {
  using C = Consequences;
  using I = Inspection;
  EXPECT_EQ(required_safety(steel_800(), C::severe, I::none, Casting::not_cast), 1.5);
  EXPECT_EQ(required_safety(steel_800(), C::moderate, I::regular, Casting::not_cast), 1.2);
  const FatigueMaterial iron{MaterialGroup::ductile_cast_iron, 400e6, 250e6, 0.15};
  EXPECT_NEAR(required_safety(iron, C::severe, I::none, Casting::untested), 2.1, 0.03);
  EXPECT_NEAR(required_safety(iron, C::moderate, I::none, Casting::untested), 1.8, 0.03);
  EXPECT_NEAR(required_safety(iron, C::severe, I::regular, Casting::tested), 1.7, 0.03);
  const FatigueMaterial brittle{MaterialGroup::ductile_cast_iron, 700e6, 420e6, 0.02};
  EXPECT_NEAR(required_safety(brittle, C::severe, I::none, Casting::untested), 2.1 + 0.3, 1e-12);
  EXPECT_THROW(required_safety(iron, C::severe, I::none, Casting::not_cast), std::invalid_argument);
}

TEST(FkmLimit, GroupsHaveNames) {
  for (const auto& row : material_groups()) EXPECT_EQ(&constants_of(row.group), &row) << row.name;
  EXPECT_THROW(require_sound({MaterialGroup::steel, 800, 600, {}}), std::invalid_argument);  // MPa for Pa
}

}  // namespace
