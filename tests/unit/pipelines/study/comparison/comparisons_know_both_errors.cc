#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipelines/study/comparison/comparison.h"

namespace pipelines {
namespace {

RunFigure zone(double x_m, double value) {
  return {FigureGroup::place, "shaft: zone at groove", "Pa", {value, value, value}, {{x_m, 0, 0}}};
}

TEST(Comparison, TellsADifferenceOnlyWhereTheBoundsDoNotMeet) {
  const auto apart = difference({100, 95, 105}, {80, 76, 84});
  EXPECT_TRUE(apart.is_told);
  EXPECT_EQ(apart.text(), "smaller by 20 +- 9 %");  // (76 - 105) / 100 to (84 - 95) / 100
  EXPECT_NEAR(*apart.least, -0.29, 1e-12);
  EXPECT_NEAR(*apart.most, -0.11, 1e-12);
  const auto near = difference({100, 95, 105}, {109, 104, 114});
  EXPECT_FALSE(near.is_told);
  EXPECT_EQ(near.text(), "no difference that the errors allow to tell");
}

TEST(Comparison, OfExactFiguresHasNoError) {
  EXPECT_EQ(difference({200, 200, 200}, {224, 224, 224}).text(), "larger by 12 %");
  EXPECT_EQ(difference({-50, -50, -50}, {-75, -75, -75}).text(), "smaller by 50 %");
  EXPECT_EQ(difference({3, 3, 3}, {3, 3, 3}).text(), "the same");
  EXPECT_EQ(difference({0, 0, 0}, {3, 3, 3}).text(), "larger");
}

TEST(Comparison, OfOneSidedBoundsNamesBoth) {
  const auto lives = difference({1000, 500, 2000}, {9000, 3000, 40000});
  EXPECT_EQ(lives.text(), "larger by 800 % (100 to 3950)");
  const double unbounded = std::numeric_limits<double>::infinity();
  EXPECT_EQ(difference({1000, 500, 2000}, {9000, 3000, unbounded}).text(), "larger by 800 % (100 to any)");
  EXPECT_EQ(difference({1000, 500, unbounded}, {9000, 3000, unbounded}).text(),
            "no difference that the errors allow to tell");
}

TEST(Comparison, SaysWhereNoErrorIsStated) {
  const double unbounded = std::numeric_limits<double>::infinity();
  const auto unknown = difference({100, -unbounded, unbounded}, {102, -unbounded, unbounded});
  EXPECT_FALSE(unknown.is_told);
  EXPECT_EQ(unknown.text(), "larger by 2 %, without a stated error");
}

TEST(Comparison, MatchesPlacesOfOneNameByTheirPosition) {
  ComparedRun first, second;
  first.figures = {zone(0.1, 10), zone(0.5, 20)};
  second.figures = {zone(0.51, 21), zone(0.11, 10), zone(0.9, 5)};
  const auto comparison = compare_runs({first, second});
  ASSERT_EQ(comparison.figures.size(), 3u);
  EXPECT_EQ(comparison.figures[0].from_first[1]->text(), "the same");
  EXPECT_EQ(comparison.figures[1].from_first[1]->text(), "larger by 5 %");
  EXPECT_FALSE(comparison.figures[2].values[0]);
  EXPECT_FALSE(comparison.figures[2].from_first[1]);
}

TEST(Comparison, ListsKeysThatDiffer) {
  ComparedRun first, second;
  first.keys = {{"machine.speed", "1450 rpm"}, {"shaft.fillet", "2 mm"}, {"title", "a"}};
  second.keys = {{"machine.speed", "1500 rpm"}, {"title", "a"}};
  const auto keys = compare_runs({first, second}).keys;
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].key, "machine.speed");
  EXPECT_EQ(keys[1].texts, (std::vector<std::string>{"2 mm", ""}));
}

}  // namespace
}  // namespace pipelines
