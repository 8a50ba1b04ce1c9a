// The worked example of ASTM E1049-85, fig. 6 (public case P22), and its form for a repeating history,
// fig. 7.
#include <gtest/gtest.h>

#include <map>

#include "kinetics/series/load_spectrum.h"

namespace {

std::map<double, double> by_range(const std::vector<kinetics::LoadCycle>& cycles) {
  std::map<double, double> counts;
  for (const auto& cycle : cycles) counts[cycle.range] += cycle.count;
  return counts;
}

Eigen::ArrayXd example() {
  Eigen::ArrayXd series(9);
  series << -2, 1, -3, 5, -1, 3, -4, 4, -2;
  return series;
}

}  // namespace

TEST(RainflowE1049, CountsOfTheExample) {
  EXPECT_EQ(by_range(kinetics::rainflow(example())),
            (std::map<double, double>{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}}));
}

// The order in which the standard's text counts, with the ends of each range: A-B, B-C, E-F (one cycle), C-D,
// D-G, G-H, H-I.
TEST(RainflowE1049, CyclesInTheOrderOfTheStandard) {
  const auto cycles = kinetics::rainflow(example());
  const double expected[][3] = {{3, -0.5, 0.5}, {4, -1, 0.5}, {4, 1, 1},  {8, 1, 0.5},
                                {9, 0.5, 0.5},  {8, 0, 0.5},  {6, 1, 0.5}};
  ASSERT_EQ(cycles.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(cycles[i].range, expected[i][0]) << i;
    EXPECT_EQ(cycles[i].mean, expected[i][1]) << i;
    EXPECT_EQ(cycles[i].count, expected[i][2]) << i;
  }
}

// The same history repeated: from D to D, with the full cycles 3, 4, 7 and 9 of the standard's fig. 7.
TEST(RainflowE1049, RepeatingHistory) {
  EXPECT_EQ(by_range(kinetics::rainflow_repeating(example())),
            (std::map<double, double>{{3, 1}, {4, 1}, {7, 1}, {9, 1}}));
}
