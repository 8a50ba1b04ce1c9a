/// Edges of STEP parts that are rounded for their effective notch stress.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/meshes/examples/imports.h"

namespace {

namespace occ = gmsh::model::occ;

constexpr double r_m = 1e-3;

/// A pad with rounded corners on a plate; its top at z = 20 mm.
meshes::Import pad_on_plate(const std::vector<meshes::PartNotch>& notches) {
  static const auto file = written("pad.step", [] {
    gmsh::vectorpair rounded, result;
    std::vector<gmsh::vectorpair> map;
    const int pad = occ::addBox(-20, -15, 10, 40, 30, 10);
    occ::synchronize();
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    std::vector<int> upright;
    for (const auto& curve : curves) {
      double low[3], high[3];
      gmsh::model::getBoundingBox(1, curve.second, low[0], low[1], low[2], high[0], high[1], high[2]);
      if (high[2] - low[2] > 5) upright.push_back(curve.second);
    }
    occ::fillet({pad}, upright, {6}, rounded);
    occ::fuse({{3, occ::addBox(-40, -30, 0, 80, 60, 10)}}, rounded, result, map);
    occ::synchronize();
  });
  auto import = import_of(file, {});
  import.notches = notches;
  return import;
}

double volume_m3(const std::vector<meshes::PartNotch>& notches) {
  return meshes::outline_imported(pad_on_plate(notches)).volume_m3;
}

}  // namespace

// The edge goes around the pad without a kink: all of it is rounded. Turns red: one straight piece alone.
TEST(RoundedNotches, GoAroundWithTheEdge) {
  const auto body = meshes::build_imported(pad_on_plate({{{0, 0.0152, 0.0102}, r_m}}));
  const double straight_m = 2 * (0.040 + 0.030 - 4 * 0.006), rounded_m = 2 * M_PI * 0.006,
               corner_m2 = (1 - M_PI / 4) * r_m * r_m;
  // Around the corners the centre of the fillet's section is 0.2234 r outside of the edge (Pappus).
  const double gained_m3 = corner_m2 * (straight_m + rounded_m + 2 * M_PI * 0.2234 * r_m);
  EXPECT_NEAR(volume_m3({{{0, 0.0152, 0.0102}, r_m}}) - volume_m3({}), gained_m3, 1e-4 * gained_m3);
  ASSERT_EQ(body.notches.size(), 8U);
  for (const auto& notch : body.notches) {
    EXPECT_EQ(notch.radius_m, r_m);
    EXPECT_EQ(body.groups.boundaries.at(notch.boundary_id).rfind("effective notch 1, fillet r 1 mm", 0), 0U);
    for (const auto& p : notch.course_m) EXPECT_NEAR(p[2], 0.010, 1e-12);
  }
  EXPECT_TRUE(body.sharp_edges.empty());
}

TEST(RoundedNotches, ThatTheKernelDoesNotMakeAreRefused) {
  const auto refusal = refusal_of([] { meshes::build_imported(pad_on_plate({{{0, 0.015, 0.010}, 0.04}})); });
  expect_words(refusal, {"the notch at (0, 15, 10) mm", "does not round", "by 40 mm", "kind = \"weld\""});
}
