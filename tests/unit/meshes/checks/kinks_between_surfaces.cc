/// Edges at which two surfaces of a part meet in a kink, turned into the material.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/meshes/examples/imports.h"

namespace {

namespace occ = gmsh::model::occ;

/// A plate whose top rises from x = 20 mm on by an angle, 10 mm wide.
std::filesystem::path ramp(double angle_deg) {
  return written("ramp.step", [&] {
    const double rise = 20 * std::tan(angle_deg * M_PI / 180);
    const int p[] = {occ::addPoint(0, 0, 0), occ::addPoint(40, 0, 0), occ::addPoint(40, 0, 10 + rise),
                     occ::addPoint(20, 0, 10), occ::addPoint(0, 0, 10)};
    std::vector<int> lines;
    for (int i = 0; i < 5; ++i) lines.push_back(occ::addLine(p[i], p[(i + 1) % 5]));
    gmsh::vectorpair made;
    occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(lines)})}}, 0, 10, 0, made);
    occ::synchronize();
  });
}

}  // namespace

// A stiffener that ends under 45 degrees, a weld's flank: stress there grows as r^-0.33. Turns red: 60
// degrees as between the cells of one surface.
TEST(KinksBetweenSurfaces, AreSharpFromTwentyFiveDegreesOn) {
  for (const double angle_deg : {20.0, 30.0, 45.0}) {
    const auto edges = meshes::build_imported(import_of(ramp(angle_deg), {})).sharp_edges;
    ASSERT_EQ(edges.size(), angle_deg > 25 ? 1U : 0U) << angle_deg;
    for (const auto& edge : edges)
      for (const auto& piece : edge.pieces)
        for (const auto& end : piece) {
          EXPECT_NEAR(end[0], 0.020, 1e-12);
          EXPECT_NEAR(end[2], 0.010, 1e-12);
        }
  }
}

// The seams of a fillet have none, however few cells are on it. Turns red: normals of flat cells, 30 degrees
// apart.
TEST(KinksBetweenSurfaces, AreNoneAtTheSeamsOfAFillet) {
  const auto file = written("filleted.step", [] {
    gmsh::vectorpair result, rounded;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addBox(0, 0, 0, 60, 40, 12)}}, {{3, occ::addBox(0, 0, 12, 12, 40, 40)}}, result, map);
    occ::synchronize();
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const auto& curve : curves) {
      double low[3], high[3];
      gmsh::model::getBoundingBox(1, curve.second, low[0], low[1], low[2], high[0], high[1], high[2]);
      if (std::abs(low[0] - 12) < 1e-3 && std::abs(high[0] - 12) < 1e-3 && std::abs(low[2] - 12) < 1e-3 &&
          std::abs(high[2] - 12) < 1e-3)
        occ::fillet({result[0].second}, {curve.second}, {6}, rounded);
    }
    occ::synchronize();
  });
  auto import = import_of(file, {});
  import.control.cells_per_circle = 6;
  EXPECT_TRUE(meshes::build_imported(import).sharp_edges.empty());
}
