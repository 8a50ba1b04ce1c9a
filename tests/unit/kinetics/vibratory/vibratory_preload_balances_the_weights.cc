#include <gtest/gtest.h>

#include "kinetics/vibratory_effects/springs.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::Vector2d;
using kinetics::VibratoryMill;
using kinetics::vibratory::with_preloads;

const std::vector<std::string> weights{"gravity_structure", "gravity_exciter", "gravity_charge", "springs"};

std::string refusal(const VibratoryMill& mill) {
  try {
    with_preloads(mill, weights);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(VibratoryPreload, CarriesForceAndMomentOfTheWeights) {
  std::mt19937 generator(7);
  for (int k = 0; k < 50; ++k) {
    auto mill = machines::random(generator);
    if (mill.springs.size() < 2) continue;
    double force = 0, moment = 0, scale = 0;
    for (const auto& spring : with_preloads(mill, weights)) {
      EXPECT_EQ(spring.preload_N->x(), 0);
      force += spring.preload_N->y();
      moment += spring.preload_N->y() * spring.position_m.x();
      scale += std::abs(spring.preload_N->y());
    }
    const double g = mill.gravity_m_s2, m = mill.charge_mass_kg, m1 = mill.structure_mass_kg;
    // Springs close together carry forces far larger than the weights: round-off goes with their sum.
    EXPECT_NEAR(force, g * (m + m1 + mill.exciter_mass_kg), 1e-12 * scale);
    EXPECT_NEAR(moment, g * (m * mill.chamber_centre_m.x() + m1 * mill.structure_centre_m.x()),
                1e-12 * scale);
  }
}

TEST(VibratoryPreload, CountsTheWeightsInEffectOnly) {
  const auto springs = with_preloads(machines::laboratory(), {"gravity_exciter", "springs"});
  EXPECT_NEAR(springs[0].preload_N->y() + springs[1].preload_N->y(), 6 * 9.81, 1e-12);
  for (const auto& spring : with_preloads(machines::laboratory(), {"springs"}))
    EXPECT_EQ(spring.preload_N->y(), 0);
}

TEST(VibratoryPreload, GivenOnesAreKept) {
  auto mill = machines::laboratory();
  mill.springs[0].preload_N = Vector2d(1, 2);
  mill.springs[1].preload_N = Vector2d(3, 4);
  EXPECT_EQ(*with_preloads(mill, weights)[1].preload_N, Vector2d(3, 4));
}

TEST(VibratoryPreload, ImpossibleBalanceIsRefused) {
  auto mill = machines::laboratory();
  mill.springs[0].preload_N = Vector2d(1, 2);
  EXPECT_NE(refusal(mill).find("or of none"), std::string::npos) << refusal(mill);
  mill = machines::laboratory();
  mill.springs.pop_back();
  EXPECT_NE(refusal(mill).find("one vertical"), std::string::npos) << refusal(mill);
  // One spring below the centre of the weights is enough: 131.454 N m / 549.36 N.
  mill.springs[0].position_m.x() = 131.454 / 549.36;
  EXPECT_EQ(refusal(mill), "accepted");
  mill = machines::laboratory();
  for (auto& spring : mill.springs) spring.stiffness_N_m.y() = 0;
  EXPECT_NE(refusal(mill).find("vertical stiffness"), std::string::npos) << refusal(mill);
}
