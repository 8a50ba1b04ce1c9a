/// Values and points of a sweep, as they are written.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/study/variations/sweep_points.h"

using namespace pipelines;
using Texts = std::vector<std::string>;

namespace {

std::string refusal_of_sweep(const SweepRequest& request) {
  try {
    (void)plan_sweep(request);
  } catch (const OptionError& error) {
    return error.what();
  }
  return "accepted";
}

SweepRequest grid(const Texts& vary) {
  SweepRequest request;
  request.vary = vary;
  return request;
}

}  // namespace

TEST(SweepValues, OfARangeHaveBothEnds) {
  const auto v = parse_variation(" machine.drive.speed = 1200..1600 rpm / 5");
  EXPECT_EQ(v.key, "machine.drive.speed");
  EXPECT_EQ(v.unit, "rpm");
  EXPECT_EQ(v.values, (Texts{"1200 rpm", "1300 rpm", "1400 rpm", "1500 rpm", "1600 rpm"}));
  EXPECT_EQ(v.numbers, (std::vector<double>{1200, 1300, 1400, 1500, 1600}));
}

TEST(SweepValues, MayHaveASlashInTheirUnit) {
  const auto v = parse_variation("k = 1..100 kN/m / 3 log");
  EXPECT_EQ(v.unit, "kN/m");
  ASSERT_EQ(v.numbers.size(), 3u);
  EXPECT_EQ(v.numbers.front(), 1);
  EXPECT_NEAR(v.numbers[1], 10, 1e-14);
  EXPECT_EQ(v.numbers.back(), 100);
  EXPECT_TRUE(parse_variation("k = 1..100 kN/m").values.empty());
}

TEST(SweepValues, OfAListShareTheUnitOfTheLast) {
  EXPECT_EQ(parse_variation("k = 1, 2.5,4 mm").values, (Texts{"1 mm", "2.5 mm", "4 mm"}));
  EXPECT_EQ(parse_variation("k = [\"1 mm\", \"2 mm\"]").numbers, (std::vector<double>{1, 2}));
  EXPECT_TRUE(parse_variation("k = 1 mm, 2 cm").numbers.empty());  // two units: no common axis
  EXPECT_EQ(parse_variation("k = 1 mm, 2 cm").values, (Texts{"1 mm", "2 cm"}));
}

TEST(SweepValues, MayBeWordsAndLists) {
  EXPECT_EQ(parse_variation("effects.pitch = on, off").values, (Texts{"on", "off"}));
  EXPECT_EQ(parse_variation("machine.springs[2] = kept, removed").values, (Texts{"kept", "removed"}));
  EXPECT_EQ(parse_variation("k = [[1, 2], [3, \"4, m\"]]").values, (Texts{"[1, 2]", "[3, \"4, m\"]"}));
  EXPECT_EQ(parse_variation("k = [1, 2], [3, 4]").values, (Texts{"[1, 2]", "[3, 4]"}));
}

TEST(SweepValues, ThatAreNoneAreRefused) {
  for (const char* text :
       {"k", "= 3", "k =", "k = 1..", "k = 1..2 rpm / 1", "k = 1..2 rpm / 2000000", "k = 0..5 m / 3 log",
        "k = 1,,2", "k = 3..3 m / 4", "k = 1 rpm..2 Hz / 3", "k = a..b / 3"})
    EXPECT_THROW((void)parse_variation(text), OptionError) << text;
}

TEST(SweepPoints, OfAGridAreAllPairsTheLastKeyFastest) {
  const auto plan = plan_sweep(grid({"a = 1, 2", "b.c = x, kept, z"}));
  ASSERT_EQ(plan.points.size(), 6u);
  EXPECT_EQ(plan.points[0].settings, (Texts{"a=1", "b.c=x"}));
  EXPECT_EQ(plan.points[1].settings, (Texts{"a=1"}));
  EXPECT_EQ(plan.points[5].settings, (Texts{"a=2", "b.c=z"}));
  EXPECT_TRUE(std::isnan(plan.points[0].numbers[1]));
}

TEST(SweepPoints, OneAtATimeLeaveTheOthers) {
  auto request = grid({"a = 1, 2", "b = 3, 4, 5"});
  request.design = SweepDesign::one_at_a_time;
  const auto plan = plan_sweep(request);
  ASSERT_EQ(plan.points.size(), 6u);
  EXPECT_TRUE(plan.points[0].settings.empty());
  EXPECT_EQ(plan.points[2].settings, (Texts{"a=2"}));
  EXPECT_EQ(plan.points[5].settings, (Texts{"b=5"}));
}

// Of each key every one of 50 shares holds one point, of a list every value as many as any other; the same
// seed draws the same points.
TEST(SweepPoints, OfALatinHypercubeFillEveryShare) {
  auto request = grid({"a = 10..20 m", "b = 1..1e4 N/m / 7 log", "c = x, y"});
  request.design = SweepDesign::latin_hypercube;
  request.n_points = 50;
  const auto plan = plan_sweep(request);
  ASSERT_EQ(plan.points.size(), 50u);
  std::set<int> first, second;
  int n_x = 0;
  for (const auto& point : plan.points) {
    EXPECT_TRUE(point.numbers[0] >= 10 && point.numbers[0] < 20);
    first.insert(int((point.numbers[0] - 10) * 5));
    second.insert(int(std::log10(point.numbers[1]) / 4 * 50));
    n_x += point.values[2] == "x";
  }
  EXPECT_EQ(first.size(), 50u);
  EXPECT_EQ(second.size(), 50u);
  EXPECT_EQ(n_x, 25);
  EXPECT_EQ(plan_sweep(request).points[17].settings, plan.points[17].settings);
  request.seed = 2;
  EXPECT_NE(plan_sweep(request).points[17].settings, plan.points[17].settings);
}

TEST(SweepPoints, ThatCannotBeMadeAreRefused) {
  EXPECT_NE(refusal_of_sweep(grid({})).find("nothing is varied"), std::string::npos);
  EXPECT_NE(refusal_of_sweep(grid({"a = 1..2 m"})).find("how many values"), std::string::npos);
  EXPECT_NE(refusal_of_sweep(grid({"a = 1, 2", "a = 3"})).find("varied already"), std::string::npos);
  EXPECT_NE(refusal_of_sweep(grid({"a = 1..2 m / 1001", "b = 1..2 m / 1000"})).find("more than a million"),
            std::string::npos);
  auto request = grid({"a = 1..2 m"});
  request.design = SweepDesign::latin_hypercube;
  EXPECT_NE(refusal_of_sweep(request).find("how many points"), std::string::npos);
}
