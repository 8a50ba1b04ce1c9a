#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "meshes/chamber/chamber.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

using meshes::Chamber;
using meshes::ChamberMeshControl;

struct RefusedChamber {
  std::string what;
  std::function<void(Chamber&, ChamberMeshControl&)> spoil;
  std::vector<std::string> expected;  ///< parts of the message
};

const double mm = 1e-3;

std::vector<RefusedChamber> size_refusals() {
  return {
      {"no radius", [](auto& c, auto&) { c.tube.inner_radius_m = 0; }, {"inner radius = 0 mm", "positive"}},
      {"nan",
       [](auto& c, auto&) { c.tube.axis_x_m = std::numeric_limits<double>::quiet_NaN(); },
       {"axis x", "finite"}},
      {"endless", [](auto& c, auto&) { c.tube.length_m = HUGE_VAL; }, {"tube's length = inf", "finite"}},
      {"thick wall",
       [](auto& c, auto&) { c.tube.wall_m = 50 * mm; },
       {"wall = 50 mm", "1.3 mm and 39 mm", "30 %"}},
      {"floating lugs",
       [](auto& c, auto&) { c.lugs.z_m = 160 * mm; },
       {"lugs' z = 160 mm", "136 mm", "must meet the tube"}},
      {"low flange",
       [](auto& c, auto&) { c.flanges.outer_radius_m = 140 * mm; },
       {"flanges' outer radius = 140 mm", "142 mm and 272 mm"}},
      {"long flanges",
       [](auto& c, auto&) { c.flanges.thickness_m = 80 * mm; },
       {"flanges' thickness = 80 mm", "70 mm"}},
      {"bore", [](auto& c, auto&) { c.housing.bore_radius_m = 64 * mm; }, {"bore radius = 64 mm", "61.75"}},
      {"no webs", [](auto& c, auto&) { c.webs.z_m.clear(); }, {"0 webs", "1 to 8"}},
      {"high webs", [](auto& c, auto&) { c.webs.height_m = 0.2; }, {"webs' height = 200 mm", "163.2 mm"}},
      {"web beyond the housing",
       [](auto& c, auto&) { c.webs.z_m[1] = 46 * mm; },
       {"web's z = 46 mm", "45.5 mm", "housing longer"}},
      {"no feet", [](auto& c, auto&) { c.feet.clear(); }, {"0 feet", "1 to 4"}},
      {"five feet", [](auto& c, auto&) { c.feet.resize(5); }, {"5 feet", "1 to 4"}},
      {"narrow lugs", [](auto& c, auto&) { c.lugs.width_m = 17 * mm; }, {"lugs' width = 17 mm", "18 mm"}},
      {"thin pads", [](auto& c, auto&) { c.pads.size_z_m = 7 * mm; }, {"lugs' thickness = 8 mm", "7 mm"}},
      {"pads meet", [](auto& c, auto&) { c.pads.size_z_m = 195 * mm; }, {"size in z = 195 mm", "194 mm"}},
      {"cells", [](auto&, auto& k) { k.cells_through_wall = 0; }, {"cells_through_wall = 0"}},
      {"many cells",
       [](auto&, auto& k) { k.cells_through_wall = k.most_cells_through_wall + 1; },
       {"cells_through_wall = 21", "1 and 20"}},
      {"size", [](auto&, auto& k) { k.size_m = -1; }, {"size_m = -1"}},
      {"growth", [](auto&, auto& k) { k.growth = 0; }, {"growth = 0"}},
      {"steep growth",
       [](auto&, auto& k) { k.growth = 1.01 * k.steepest_growth; },
       {"growth = 2.02", "at most 2"}},
      {"quality", [](auto&, auto& k) { k.min_scaled_jacobian = 1.5; }, {"min_scaled_jacobian = 1.5"}},
  };
}

std::vector<RefusedChamber> clearance_refusals() {
  return {
      {"housing in the tube",
       [](auto& c, auto&) { c.tube.axis_x_m = 200 * mm; },
       {"the tube and the housing", "2.96078 mm apart", "at least 6 mm"}},
      {"flange at the housing",
       [](auto& c, auto&) {
         c.housing.length_m = 260 * mm;
         c.flanges.outer_radius_m = 220 * mm;
       },
       {"the flanges and the housing", "in z", "move them apart"}},
      {"lug in the flange",
       [](auto& c, auto&) { c.lugs.z_m = 120 * mm; },
       {"the flanges and lug 1", "4 mm in z"}},
      {"webs meet",
       [](auto& c, auto&) {
         c.webs.z_m = {0, 19 * mm};
       },
       {"web 1 and web 2", "5 mm in z"}},
      {"lug in a web",
       [](auto& c, auto&) {
         c.feet[0] = {0.05, -0.12};
         c.lugs.z_m = 45 * mm;
       },
       {"web 1 and lug 1"}},
      {"feet together",
       [](auto& c, auto&) {
         c.feet[1] = {0.14, -0.2};
       },
       {"lug 1 and lug 2 are 0 mm apart"}},
      {"pad at the tube",
       [](auto& c, auto&) {
         c.feet[0] = {0.2, -0.1};
       },
       {"the tube and pad 1"}},
      {"foot at the axis",
       [](auto& c, auto&) {
         c.feet[0] = {0.28, 0.04};
       },
       {"the tube and pad 1 are 0 mm"}},
      {"pad in the housing",
       [](auto& c, auto&) {
         c.feet[0] = {0.02, -0.08};
         c.lugs.z_m = 60 * mm;
       },
       {"the housing and pad 1"}},
      {"steep webs",
       [](auto& c, auto&) {
         c.housing.outer_radius_m = 30 * mm;
         c.housing.bore_radius_m = 20 * mm;
         c.webs.height_m = 160 * mm;
         c.tube.axis_x_m = 185 * mm;
       },
       {"edge of the webs shifts by 56 mm", "1 in 2", "webs lower"}},
      {"steep lug",
       [](auto& c, auto&) {
         c.lugs.width_m = 130 * mm;
         c.pads.size_x_m = c.pads.size_y_m = 10 * mm;
         c.feet = {{0.28, -0.2}};
       },
       {"an edge of lug 1 shifts by 60 mm", "width nearer"}},
      {"faces that nearly meet",
       [](auto& c, auto&) { c.housing.length_m = 104.2 * mm; },
       {"web", "the housing's end", "0.1 mm apart", "0.3 mm", "coincide"}},
  };
}

void expect_chambers_refused(const std::vector<RefusedChamber>& refusals) {
  for (const auto& refusal : refusals) {
    SCOPED_TRACE(refusal.what);
    Chamber chamber = laboratory_chamber();
    ChamberMeshControl control;
    refusal.spoil(chamber, control);
    try {
      meshes::build_chamber(chamber, control);
      ADD_FAILURE() << "was meshed";
    } catch (const std::invalid_argument& error) {
      for (const auto& part : refusal.expected)
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
            << error.what() << "\nlacks: " << part;
    }
  }
}

TEST(RefusedChambers, HaveSizesOutOfRange) {
  expect_chambers_refused(size_refusals());
}

TEST(RefusedChambers, HavePartsInEachOthersWay) {
  expect_chambers_refused(clearance_refusals());
}

TEST(RefusedChambers, NameTheWorstCell) {
  ChamberMeshControl control;
  control.min_scaled_jacobian = 0.95;
  try {
    meshes::build_chamber(laboratory_chamber(), control);
    ADD_FAILURE() << "was meshed";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    for (const std::string part : {"scaled Jacobian is 0.6", "(x, y, z)", "wanted 0.95", "lugs as wide"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

/// Faces that coincide are one station.
TEST(RefusedChambers, DoNotIncludeWebsFlushWithTheHousing) {
  auto chamber = laboratory_chamber();
  chamber.webs.z_m = {-45.5 * mm, 45.5 * mm};
  EXPECT_LT(meshes::build_chamber(chamber, {}).quality.max_aspect, 42);
}

}  // namespace
