#include <gtest/gtest.h>

#include <cmath>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/shaft_volume.h"

namespace {

std::array<double, 4> meshed(const meshes::Shaft& shaft, int cells, int sectors) {
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = cells;
  control.n_sectors = sectors;
  return volume_and_moments(read_mesh_file(meshes::build_shaft(shaft, control)));
}

/// 1e4 to 1e5 cells are summed, each right to about 1e-15 of itself; nodes pass through 16 decimal digits.
const double rounding = 1e-12;

/// Every cross-section is a regular polygon, so the volume of the linear mesh is known exactly.
TEST(ShaftVolume, IsThatOfThePolygonalBody) {
  for (const int sectors : {8, 12, 16, 32}) {
    for (const auto& shaft : {plain_cylinder(), three_steps(), sharp_eccentric_shaft(),
                              shoulder_shaft(2, 0.1), shoulder_shaft(1.1, 0.05), laboratory_shaft()})
      for (const int cells : {2, 8}) {
        const double expected = polygonal_volume(shaft, cells, sectors);
        EXPECT_NEAR(meshed(shaft, cells, sectors)[0], expected, rounding * expected)
            << shaft.segments.front().name << ", sectors " << sectors << ", cells " << cells;
      }
  }
}

TEST(ShaftVolume, IsThatOfThePolygonalBodyLessItsBores) {
  auto shafts = stepped_bores();
  for (const auto& shaft :
       {planetary_drum(), working_shaft(), stub_axle(), two_eccentrics(), grooved_shaft()})
    shafts.push_back(shaft);
  for (const auto& shaft : shafts)
    for (const int cells : {2, 6}) {
      const double expected = polygonal_volume(shaft, cells, 24);
      EXPECT_NEAR(meshed(shaft, cells, 24)[0], expected, rounding * expected)
          << shaft.segments.front().name << ", cells " << cells;
    }
}

/// Both offsets at once, in different directions: each seat's offset times its own volume. The bore is
/// concentric and adds nothing.
TEST(ShaftVolume, HasTheFirstMomentsOfSeatsInAnyDirection) {
  const auto sums = meshed(two_eccentrics(), 6, 16);
  const double tiny = rounding * sums[0] * 0.03;
  EXPECT_NEAR(sums[1], -0.005 * polygon_area(0.033, 16) * 0.025, tiny);
  EXPECT_NEAR(sums[2], 0.004 * polygon_area(0.03, 16) * 0.03, tiny);
}

/// The eccentric seat alone has a first moment in x: offset times its polygonal volume. A shift of the wrong
/// segment, or one that is not complete at the surface, would change it.
TEST(ShaftVolume, HasTheFirstMomentOfTheEccentricSeat) {
  const auto shaft = laboratory_shaft();
  const auto sums = meshed(shaft, 8, 16);
  const double expected = 0.004 * polygon_area(0.03, 16) * 0.06;
  EXPECT_NEAR(sums[1], expected, rounding * sums[0] * 0.03);
  EXPECT_NEAR(sums[2], 0, rounding * sums[0] * 0.03);
}

/// Chords cut off 2 pi^2 / (3 N^2) of the section, chords of the arc (pi/2n)^2 of the fillet's small corner:
/// second order.
TEST(ShaftVolume, ConvergesToTheClosedFormWithSecondOrder) {
  for (const auto& shaft : {laboratory_shaft(), shoulder_shaft(2, 0.2)}) {
    const double exact = true_volume(shaft);
    double previous = 0;
    for (const int sectors : {8, 16, 32}) {
      const double error = exact - meshed(shaft, sectors / 2, sectors)[0];
      EXPECT_GT(error, 0);
      if (previous > 0) {
        // The next term of the expansion is (2 pi / N)^4: at 8 sectors 3 % of the first, so the order is 2
        // within 0.05.
        EXPECT_NEAR(std::log2(previous / error), 2, 0.05);
      }
      previous = error;
    }
  }
}

}  // namespace
