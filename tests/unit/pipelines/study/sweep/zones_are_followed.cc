/// Which zones of different points are called one.
#include <gtest/gtest.h>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/sweep/swept_zones.h"
#include "pipelines/study/variations/sweep_points.h"

using namespace pipelines;

namespace {

/// A cube of 2 mm around a peak on the x axis.
SweptZone zone_at(double x_mm, double peak_Pa, const std::string& body = "shaft") {
  SweptZone zone;
  zone.body = body;
  zone.peak_Pa = peak_Pa;
  zone.peak_m = {1e-3 * x_mm, 0, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    zone.low_m[c] = zone.peak_m[c] - 1e-3;
    zone.high_m[c] = zone.peak_m[c] + 1e-3;
  }
  return zone;
}

std::vector<std::vector<int>> followed(const std::vector<std::vector<SweptZone>>& points,
                                       const std::string& vary, SweepDesign design = SweepDesign::grid) {
  SweepRequest request;
  request.vary = {vary};
  request.design = design;
  std::vector<SweepRow> rows;
  for (const auto& zones : points) {
    rows.emplace_back();
    rows.back().zones = zones;
  }
  return follow_zones(plan_sweep(request), rows);
}

}  // namespace

// Two zones move by less than their size from point to point and change their rank; a third comes, and is
// gone at the last point. Numbers go by the largest peak of all points.
TEST(SweptZones, KeepTheirNumberWhileTheyMove) {
  using Numbers = std::vector<std::vector<int>>;
  EXPECT_EQ(followed({{zone_at(0, 100), zone_at(50, 90)},
                      {zone_at(51.5, 120), zone_at(1.5, 110), zone_at(20, 60)},
                      {zone_at(53, 140), zone_at(3, 115)}},
                     "speed = 1..3 rpm / 3"),
            (Numbers{{2, 1}, {1, 2, 3}, {1, 2}}));
}

TEST(SweptZones, OfOtherBodiesAreOthers) {
  using Numbers = std::vector<std::vector<int>>;
  EXPECT_EQ(
      followed({{zone_at(0, 100)}, {zone_at(0, 90, "chamber"), zone_at(0, 80)}}, "speed = 1..2 rpm / 2"),
      (Numbers{{1}, {1, 1}}));
}

// Gone at one point and back at the next; the refused point between has none at all.
TEST(SweptZones, ThatWereGoneComeBack) {
  using Numbers = std::vector<std::vector<int>>;
  EXPECT_EQ(followed({{zone_at(0, 100), zone_at(50, 90)}, {zone_at(50, 95)}, {}, {zone_at(0, 80)}},
                     "speed = 1..4 rpm / 4"),
            (Numbers{{1, 2}, {2}, {}, {1}}));
}

// One zone falls in two: the half with the nearer peak keeps the number.
TEST(SweptZones, ThatDivideLeaveTheNumberToTheNearerHalf) {
  auto whole = zone_at(0, 100);
  whole.low_m[0] = -5e-3;
  whole.high_m[0] = 5e-3;
  using Numbers = std::vector<std::vector<int>>;
  EXPECT_EQ(followed({{whole}, {zone_at(4, 130), zone_at(-1, 120)}}, "speed = 1..2 rpm / 2"),
            (Numbers{{2}, {1, 2}}));
}

// The last point is next to the first, not to the one before it: there the zone had walked away.
TEST(SweptZones, AreThoseOfTheNearestPoint) {
  using Numbers = std::vector<std::vector<int>>;
  EXPECT_EQ(
      followed(
          {{zone_at(0, 100)}, {zone_at(1.9, 110)}, {zone_at(3.8, 120)}, {zone_at(0, 105), zone_at(3.8, 50)}},
          "speed = 10, 20, 30, 11 rpm"),
      (Numbers{{1}, {1}, {1}, {1, 2}}));
}
