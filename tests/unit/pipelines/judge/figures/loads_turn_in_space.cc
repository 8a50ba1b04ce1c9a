/// At which orders the loads of a shaft go round in space, seen from axes that turn with it.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/figures/critical_speeds.h"

using namespace pipelines;

namespace {

constexpr int n_instants = 48, n_turns = 2;

/// A force that goes round in the axes `order` times a turn of the drive, counter-clockwise where above 0.
ChannelHistory going_round(double order, double size_N, const std::string& port = "seat") {
  ChannelHistory history{"shaft", {{port + ".fx", "N"}, {port + ".fy", "N"}}, {}, {}, {}};
  history.values.resize(2, n_instants);
  for (int i = 0; i < n_instants; ++i) {
    const double angle = order * 2 * pi * n_turns * i / n_instants;
    history.values.col(i) << size_N * std::cos(angle), size_N * std::sin(angle);
  }
  return history;
}

ChannelHistory together(ChannelHistory a, const ChannelHistory& b) {
  for (const auto& channel : b.channels) a.channels.push_back(channel);
  Eigen::ArrayXXd values(a.values.rows() + b.values.rows(), n_instants);
  values << a.values, b.values;
  a.values = values;
  return a;
}

/// The share of an order; none: 0.
double share_of(const std::vector<TurningLoad>& loads, double order) {
  for (const auto& load : loads)
    if (std::abs(load.order - order) < 1e-5) return load.share;
  return 0;
}

}  // namespace

// In axes that turn clockwise a belt's pull, at rest in space, goes round counter-clockwise.
// Turns red: the turning of the axes with the wrong sign (the belt then has the order 2), imbalance left out.
TEST(TurningLoads, AForceAtRestInSpaceShakesNothing) {
  for (const int turning : {1, -1}) {
    const auto loads = turning_loads(together(going_round(-turning, 100), going_round(0, 50, "disc")),
                                     n_turns, 1, turning, false, 0);
    ASSERT_EQ(loads.size(), 1u) << turning;
    EXPECT_EQ(loads[0].order, 1);
    EXPECT_NEAR(loads[0].share, 0.5, 1e-12);
  }
}

// Turns red: forward and backward exchanged, halves of an oscillating force forgotten.
TEST(TurningLoads, GoRoundForwardAndBackward) {
  auto oscillating = going_round(3, 100);
  oscillating.values.row(1) = 0;
  const auto loads = turning_loads(oscillating, n_turns, 1, -1, false, 0);
  ASSERT_EQ(loads.size(), 3u);
  EXPECT_NEAR(share_of(loads, -2), 0.5, 1e-12);  // counter-clockwise in axes that turn clockwise
  EXPECT_NEAR(share_of(loads, 4), 0.5, 1e-12);
  EXPECT_EQ(share_of(loads, 1), 0);  // imbalance, which every shaft has
}

// A shaft that turns twice a turn of the drive: order 3 of the drive is 1.5 of the shaft.
// Turns red: orders of the drive taken for those of the shaft.
TEST(TurningLoads, AreCountedByTurnsOfTheShaft) {
  const auto loads = turning_loads(going_round(3, 100), n_turns, 2, 1, false, 0);
  EXPECT_NEAR(share_of(loads, 2.5), 1, 1e-12);
}

// Turns red: one of the three ways in which a table's axes may turn left out.
TEST(TurningLoads, OfATableCountInEachWay) {
  const auto loads = turning_loads(going_round(2, 100), n_turns, 1, 0, true, 0);
  for (const double order : {3, -1, 2, -2}) EXPECT_NEAR(share_of(loads, order), 1, 1e-12) << order;
}

// Turns red: the mass forgotten.
TEST(TurningLoads, AccelerationsHaveTheMass) {
  auto weight = going_round(2, 10, "volume");
  weight.channels = {{"volume.ax", "m/s2"}, {"volume.ay", "m/s2"}};
  const auto loads = turning_loads(together(weight, going_round(0, 100)), n_turns, 1, 1, false, 5);
  EXPECT_NEAR(share_of(loads, 3), 0.5, 1e-12);
}
