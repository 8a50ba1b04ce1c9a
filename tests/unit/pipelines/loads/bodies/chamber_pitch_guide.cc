/// With the pitch off something holds the chamber's attitude: a pure couple, of the size in coupling.md
/// section 3, that changes no force.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/pipelines/examples/chamber_body.h"

namespace {

using Eigen::ArrayXd;
using pipelines::PitchGuide;

/// What the effect `pitch_guide` brings on its own, rows as in Wrench.
pipelines::Wrench guide_of(const pipelines::BodyLoads& loads,
                           const std::vector<pipelines::RegionMass>& regions) {
  pipelines::Wrench sum = pipelines::Wrench::Zero(6, loads.history.values.cols());
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto unit = pipelines::wanted_resultant(loads.unit_loads[k], regions);
    const ArrayXd values = bodies::part(loads, "pitch_guide", loads.history.channels[k].name);
    for (Eigen::Index c = 0; c < 6; ++c) sum.row(c) += unit[std::size_t(c)] * values.transpose();
  }
  return sum;
}

double rms(const ArrayXd& values) {
  return std::sqrt(values.square().mean());
}

class Guide : public testing::TestWithParam<PitchGuide> {};

// 1237 N m, rms 832, mean 0; printed without digits after the point.
TEST_P(Guide, IsAPureCoupleOfTheResidualsSize) {
  const auto body = chamber::body();
  const auto result = chamber::distribute(chamber::spec_effects({"pitch"}), body, GetParam());
  EXPECT_LT(result.closure.worst_force(), 1e-12);
  EXPECT_LT(result.closure.worst_moment(), 1e-12);
  const auto& carried = result.loads.carried_moment_Nm;
  EXPECT_NEAR(bodies::largest(carried), 1237, 1);
  EXPECT_NEAR(rms(carried), 832, 1);
  EXPECT_NEAR(carried.mean(), 0, 1);
  // It is what the load stage says that is left.
  const ArrayXd left = result.history.quantity("moment_residual").values;
  EXPECT_LT(bodies::largest(carried + left), 1e-9 * bodies::largest(left));
  // 76 % of the moments' scale.
  EXPECT_NEAR(bodies::largest(carried) / result.loads.carried_moment_scale_Nm, 0.76, 0.005);
  const auto guide = guide_of(result.loads, body.regions);
  EXPECT_LT(bodies::largest(guide.topRows<3>()), 1e-9);
  EXPECT_LT(bodies::largest(guide.row(5).transpose() - carried), 1e-9);
}

// The joint's force is what it is without a body: nothing of the couple leaks into B.
TEST_P(Guide, LeavesTheJointAlone) {
  const auto result = chamber::distribute(chamber::spec_effects({"pitch"}), chamber::body(), GetParam());
  const auto& bore = result.history.resultant("housing_bore").total;
  EXPECT_LT(bodies::largest(bodies::force(result.loads, "housing_bore") - bore.topRows<2>()), 1e-9);
  EXPECT_EQ(bodies::largest(bodies::part(result.loads, "pitch_guide", "housing_bore.fx")), 0);
}

TEST_P(Guide, IsNotThereWherePitchIsOn) {
  const auto result = chamber::distribute(chamber::spec_effects(), chamber::body(), GetParam());
  EXPECT_EQ(result.loads.carried_moment_Nm.size(), 0);
  const auto& effects = result.loads.history.effects;
  EXPECT_EQ(std::count(effects.begin(), effects.end(), "pitch_guide"), 0);
}

INSTANTIATE_TEST_SUITE_P(both, Guide, testing::Values(PitchGuide::body, PitchGuide::feet),
                         [](const auto& test) { return test.param == PitchGuide::body ? "body" : "feet"; });

// Springs and damping off too: 1436 N m, mean -131.
TEST(PitchGuide, CarriesTheWeightsMomentWithoutSprings) {
  const auto result = chamber::distribute(chamber::spec_effects({"pitch", "springs", "spring_damping"}));
  EXPECT_LT(result.closure.worst_moment(), 1e-12);
  EXPECT_NEAR(bodies::largest(result.loads.carried_moment_Nm), 1436, 1);
  EXPECT_NEAR(std::abs(result.loads.carried_moment_Nm.mean()), 131, 1);
  EXPECT_NEAR(1436 / result.loads.carried_moment_scale_Nm, 1, 0.005) << "100 % of the scale";
}

// By the body: -rho (M / I_G) z x (p - p_G) is a rotation about the mass centre of all that moves. A rotation
// about E' would carry m1 |l| M / I_E = 3.4 kN.
TEST(PitchGuide, TurnsTheBodyAboutItsMassCentre) {
  const auto body = chamber::body();
  const auto result = chamber::distribute(chamber::spec_effects({"pitch"}), body);
  const auto m = chamber::mill();
  const double mass = 36, x = 30 * 0.26 / mass, y = 30 * 0.02 / mass;
  const double I_G = m.pitch_inertia_kg_m2 - mass * (x * x + y * y);
  const ArrayXd angular = result.loads.carried_moment_Nm / I_G;
  for (const char* region : {"volume.structure", "volume.exciter"}) {
    const auto part = [&](const char* component) {
      return bodies::part(result.loads, "pitch_guide", region + std::string(component));
    };
    const double size = bodies::largest(angular);
    EXPECT_LT(bodies::largest(part(".az") - angular), 1e-12 * size) << region;
    EXPECT_LT(bodies::largest(part(".ax") - y * angular), 1e-12 * size) << region;
    EXPECT_LT(bodies::largest(part(".ay") + x * angular), 1e-12 * size) << region;
  }
  const double about_E = 30 * std::hypot(0.26, 0.02) * bodies::largest(result.loads.carried_moment_Nm) / 2.85;
  EXPECT_NEAR(about_E, 3400, 20);
}

// On the feet: +M / (p_2x - p_1x) upwards on one of them and the opposite on the other.
TEST(PitchGuide, PullsAndPushesTheFeet) {
  const auto result =
      chamber::distribute(chamber::spec_effects({"pitch"}), chamber::body(), PitchGuide::feet);
  const ArrayXd force = result.loads.carried_moment_Nm / (0.46 - 0.1);
  EXPECT_LT(bodies::largest(bodies::part(result.loads, "pitch_guide", "spring_foot_2.fy") - force), 1e-9);
  EXPECT_LT(bodies::largest(bodies::part(result.loads, "pitch_guide", "spring_foot_1.fy") + force), 1e-9);
  EXPECT_EQ(bodies::largest(bodies::part(result.loads, "pitch_guide", "volume.structure.az")), 0);
}

}  // namespace
