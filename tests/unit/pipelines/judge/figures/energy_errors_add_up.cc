#include "pipelines/judge/figures/energy_errors.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pipelines;

namespace {

constexpr double rounding = 1e-14;

/// Norms 2 and 3 whose stresses have the product c, with errors of a and b times the norms at right angles.
fem::EnergyError two_channels(double c, double a, double b) {
  fem::EnergyError e;
  e.norm_sqrtJ = {2, 3};
  e.energy = {1, c, c, 1};
  e.error = {a * a, 0, 0, b * b};
  return e;
}

double relative(double error, double cells) {
  return error / std::hypot(error, cells);
}

}  // namespace

TEST(EnergyErrors, OfChannelsAreTheirOwn) {
  const auto errors = energy_errors(two_channels(0.5, 0.2, 0.1), Eigen::ArrayXXd::Ones(2, 1));
  ASSERT_EQ(errors.channels.size(), 2u);
  EXPECT_NEAR(errors.channels[0], relative(0.2, 1), rounding);
  EXPECT_NEAR(errors.channels[1], relative(0.1, 1), rounding);
}

// |2 x + 3 y|^2 = 4 + 2 * 2 * 3 c + 9 for unit x and y with the product c; errors 0.4 and 0.3 make 0.5.
TEST(EnergyErrors, OfASumKnowHowChannelsMeet) {
  for (const double c : {-0.5, 0.0, 0.5}) {
    const auto errors = energy_errors(two_channels(c, 0.2, 0.1), Eigen::ArrayXXd::Ones(2, 1));
    EXPECT_NEAR(errors.over_cycle, relative(0.5, std::sqrt(13 + 12 * c)), rounding) << c;
  }
}

// At an instant of small loads the error may be a large share of little: what counts is the cycle's largest.
TEST(EnergyErrors, OverTheCycleAreOfItsLargestStress) {
  Eigen::ArrayXXd factors(2, 3);
  factors << 0.01, 1, 0, 0, 0, -1;
  const auto errors = energy_errors(two_channels(0, 0.2, 0.1), factors);
  EXPECT_NEAR(errors.over_cycle, 0.4 / std::hypot(0.3, 3), rounding);
}

TEST(EnergyErrors, OfAnySizeOfLoad) {
  const auto usual = energy_errors(two_channels(0.5, 0.2, 0.1), Eigen::ArrayXXd::Ones(2, 1));
  for (const double size : {1e-150, 1e150}) {
    auto channels = two_channels(0.5, 0.2, 0.1);
    for (double& norm : channels.norm_sqrtJ) norm *= size;
    EXPECT_NEAR(energy_errors(channels, Eigen::ArrayXXd::Ones(2, 1)).over_cycle, usual.over_cycle, rounding);
    EXPECT_NEAR(energy_errors(two_channels(0.5, 0.2, 0.1), Eigen::ArrayXXd::Constant(2, 1, size)).over_cycle,
                usual.over_cycle, rounding);
  }
}

TEST(EnergyErrors, OfNothingAreNone) {
  EXPECT_EQ(energy_errors(two_channels(0, 0.2, 0.1), Eigen::ArrayXXd::Zero(2, 4)).over_cycle, 0);
  const auto cheap = energy_errors({}, Eigen::ArrayXXd::Ones(2, 4));
  EXPECT_TRUE(cheap.channels.empty());
  EXPECT_EQ(cheap.over_cycle, 0);
}
