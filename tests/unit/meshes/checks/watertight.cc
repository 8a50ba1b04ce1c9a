#include <gtest/gtest.h>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/watertight_body.h"

namespace {

void expect_watertight(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control,
                       const std::string& name) {
  SCOPED_TRACE(name);
  ::expect_watertight(meshes::build_shaft(shaft, control));
}

TEST(ShaftMesh, IsWatertightWithEveryFreeFaceInExactlyOneGroup) {
  meshes::ShaftMeshControl control;
  expect_watertight(laboratory_shaft(), control, "laboratory");
  expect_watertight(plain_cylinder(), control, "cylinder");
  expect_watertight(three_steps(), control, "three_steps");
  expect_watertight(sharp_eccentric_shaft(), control, "sharp_eccentric");
  expect_watertight(shoulder_shaft(1.1, 0.05), control, "fillet_as_high_as_the_step");
  expect_watertight(shoulder_shaft(2, 0.2), control, "deep_fillet");
}

TEST(ShaftMesh, IsWatertightWithBoresGroovesAndSeveralEccentrics) {
  for (const int cells : {2, 6})
    for (const int sectors : {8, 24}) {
      meshes::ShaftMeshControl control;
      control.cells_per_fillet_quarter = cells;
      control.n_sectors = sectors;
      expect_watertight(planetary_drum(), control, "drum");
      expect_watertight(two_eccentrics(), control, "two_eccentrics");
      expect_watertight(grooved_shaft(), control, "grooved");
      for (const auto& shaft : stepped_bores()) expect_watertight(shaft, control, "stepped_bore");
    }
}

TEST(ShaftMesh, IsWatertightAtOtherResolutions) {
  for (const int cells : {2, 4, 16})
    for (const int sectors : {8, 12, 20, 32}) {
      meshes::ShaftMeshControl control;
      control.cells_per_fillet_quarter = cells;
      control.n_sectors = sectors;
      expect_watertight(laboratory_shaft(), control, std::to_string(cells) + "_" + std::to_string(sectors));
    }
}

}  // namespace
