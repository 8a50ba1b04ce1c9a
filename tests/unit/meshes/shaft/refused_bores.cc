#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/refusals.h"

namespace {

using meshes::Shaft;

const double nan = std::numeric_limits<double>::quiet_NaN();
const double millimetre = 1e-3;

void bore_all(Shaft& shaft, double bore_m) {
  for (auto& segment : shaft.segments) segment.bore_m = bore_m;
}

/// One after another along z, sharp shoulders: diameter, length, bore in mm.
Shaft chain(const std::vector<std::array<double, 3>>& pieces) {
  Shaft shaft;
  double z_m = 0;
  for (const auto& [diameter, length, bore] : pieces) {
    meshes::ShaftSegment segment;
    segment.name = std::string(1, static_cast<char>('a' + shaft.segments.size()));
    segment.begin_m = z_m;
    segment.end_m = z_m = z_m + length * millimetre;
    segment.diameter_m = diameter * millimetre;
    segment.bore_m = bore * millimetre;
    shaft.segments.push_back(segment);
  }
  shaft.fillets_m.assign(pieces.size() - 1, 0);
  return shaft;
}

TEST(RefusedBores, HaveSizesThatCannotBe) {
  expect_refused(
      {{"NaN bore", [](Shaft& s, auto&) { s.segments[3].bore_m = nan; }, {"body_1", "bore nan mm"}},
       {"negative bore",
        [](Shaft& s, auto&) { s.segments[3].bore_m = -1 * millimetre; },
        {"bore -1 mm", "positive"}},
       {"bore as wide as the segment",
        [](Shaft& s, auto&) { bore_all(s, 25 * millimetre); },
        {"coupling", "bore 25 mm", "wall of 0 mm", "1 % of the diameter"}},
       {"needle bore",
        [](Shaft& s, auto&) { bore_all(s, 0.2 * millimetre); },
        {"coupling", "bore 0.2 mm", "1 %"}},
       {"wall thinner than half the fillet",
        [](Shaft& s, auto&) { bore_all(s, 24.2 * millimetre); },
        {"between coupling and debalance_1", "radius 1 mm", "wall of 0.4 mm", "bore 24.2 mm",
         "half the fillet"}},
       {"bores that hardly differ",
        [](Shaft& s, auto&) {
          bore_all(s, 10 * millimetre);
          s.segments[3].bore_m = 10.000000001 * millimetre;
        },
        {"body_1", "differ by", "same number"}}});
}

TEST(RefusedBores, StepWhereNoRowOfCellsCanFollow) {
  expect_refused(
      {{"wall thin over the wide bore next door",
        [](Shaft& s, auto&) {
          s = chain({{50, 100, 48}, {50, 100, 0}, {90, 100, 0}});
          s.fillets_m[1] = 3 * millimetre;
        },
        {"between b and c", "radius 3 mm", "wall of 1 mm", "bore 48 mm"}},
       {"in an eccentric seat",
        [](Shaft& s, auto&) {
          bore_all(s, 10 * millimetre);
          s.segments[5].bore_m = s.segments[6].bore_m = s.segments[7].bore_m = 12 * millimetre;
        },
        {"eccentric_seat (bore 10 mm) and body_2 (bore 12 mm)", "eccentric by 4 mm", "one segment further"}},
       {"in the plane of a fillet",
        [](Shaft& s, auto&) { s.segments[0].bore_m = 10 * millimetre; },
        {"coupling (bore 10 mm) and debalance_1 (solid)", "fillet 1 mm", "divide a segment"}},
       {"wider than the neighbour",
        [](Shaft& s, auto&) {
          s = chain({{50, 100, 0}, {90, 100, 60}});
        },
        {"a (solid) and b (bore 60 mm)", "leaves -5 mm of diameter 50 mm"}},
       {"too close to a fillet",
        [](Shaft& s, auto&) {
          s = chain({{50, 100, 0}, {90, 4, 0}, {90, 100, 58}});
          s.fillets_m[0] = 8 * millimetre;
        },
        {"z = 100 to 104 mm", "diameter 90 mm", "too short", "to 33 mm within 2.8 mm",
         "move the bore step"}}});
}

TEST(RefusedBores, HaveNamesThatClash) {
  expect_refused({{"bore port without a bore",
                   [](Shaft& s, auto&) { s.segments[3].bore_port = "wall"; },
                   {"body_1", "bore_port 'wall'", "bore is 0 mm"}},
                  {"bore port named as a segment",
                   [](Shaft& s, auto&) {
                     bore_all(s, 10 * millimetre);
                     s.segments[3].bore_port = "coupling";
                   },
                   {"body_1", "'coupling'", "something else has this name"}},
                  {"bore port named as an end",
                   [](Shaft& s, auto&) {
                     bore_all(s, 10 * millimetre);
                     s.segments[3].bore_port = "end_2";
                   },
                   {"body_1", "'end_2'", "something else has this name"}},
                  {"bore ports named alike",
                   [](Shaft& s, auto&) {
                     bore_all(s, 10 * millimetre);
                     s.segments[3].bore_port = s.segments[4].bore_port = "wall";
                   },
                   {"eccentric_seat", "'wall'", "rename"}},
                  {"bore port with a line break",
                   [](Shaft& s, auto&) {
                     bore_all(s, 10 * millimetre);
                     s.segments[3].bore_port = "a\nb";
                   },
                   {"body_1", "line breaks"}},
                  {"segment named as a bore",
                   [](Shaft& s, auto&) {
                     bore_all(s, 10 * millimetre);
                     s.segments[3].name = "bore coupling";
                   },
                   {"'bore coupling'", "bore of segment coupling"}}});
}

}  // namespace
