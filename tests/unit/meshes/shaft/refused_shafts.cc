#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/refusals.h"

namespace {

using meshes::Shaft;
using meshes::ShaftMeshControl;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double in_m = 1e-3;

std::vector<Refusal> refusals() {
  return {
      {"gap",
       [](Shaft& s, auto&) { s.segments[3].begin_m = -168 * in_m; },
       {"gap of 0.5 mm", "main_bearing_1", "body_1"}},
      {"overlap",
       [](Shaft& s, auto&) { s.segments[3].begin_m = -169 * in_m; },
       {"overlap of 0.5 mm", "-168.5 mm"}},
      {"no segments", [](Shaft& s, auto&) { s = {}; }, {"no segments"}},
      {"fillet count",
       [](Shaft& s, auto&) { s.fillets_m.pop_back(); },
       {"8 segments need 7 fillets", "there are 6"}},
      {"backwards",
       [](Shaft& s, auto&) { s.segments[0].end_m = -280 * in_m; },
       {"coupling", "-272.5 mm to -280 mm"}},
      {"zero diameter",
       [](Shaft& s, auto&) { s.segments[2].diameter_m = 0; },
       {"main_bearing_1", "diameter 0 mm"}},
      {"NaN diameter",
       [](Shaft& s, auto&) { s.segments[2].diameter_m = not_a_number; },
       {"main_bearing_1", "diameter nan"}},
      {"NaN length", [](Shaft& s, auto&) { s.segments[7].end_m = not_a_number; }, {"debalance_2", "nan"}},
      {"NaN eccentricity",
       [](Shaft& s, auto&) { s.segments[4].eccentricity_m = not_a_number; },
       {"eccentricity nan"}},
      {"NaN fillet",
       [](Shaft& s, auto&) { s.fillets_m[2] = not_a_number; },
       {"fillet", "main_bearing_1 and body_1", "nan"}},
      {"negative fillet",
       [](Shaft& s, auto&) { s.fillets_m[2] = -1 * in_m; },
       {"radius -1 mm", "0 for a sharp"}},
      {"names twice", [](Shaft& s, auto&) { s.segments[5].name = "body_1"; }, {"two segments", "'body_1'"}},
      {"no name", [](Shaft& s, auto&) { s.segments[5].name = ""; }, {"no name", "30 mm"}},
      {"name of an end", [](Shaft& s, auto&) { s.segments[5].name = "end_1"; }, {"'end_1'", "rename"}},
      {"name with quotes", [](Shaft& s, auto&) { s.segments[5].name = "a\"b"; }, {"quotes", "rename"}},
      {"fillet above step",
       [](Shaft& s, auto&) { s.fillets_m[0] = 2.6 * in_m; },
       {"radius 2.6 mm", "step of 2.5 mm", "diameter 25 mm to 30 mm", "make it smaller"}},
      {"fillet above the low side",
       [](Shaft& s, auto&) { s.fillets_m[3] = 5 * in_m; },
       {"radius 5 mm", "smaller than 5 mm", "low side", "eccentric by 4 mm", "diameter 42 mm"}},
      {"fillet longer than its segment",
       [](Shaft& s, auto&) {
         s.segments = {{"disc", 0, 2.2 * in_m, 30 * in_m, 0, false},
                       {"wheel", 2.2 * in_m, 40 * in_m, 60 * in_m, 0, false}};
         s.fillets_m = {2 * in_m};
       },
       {"disc", "2.2 mm long", "fillets of 0 mm and 2 mm", "90 %"}},
      {"two fillets longer than their segment",
       [](Shaft& s, auto&) {
         s.segments = {{"wheel_1", 0, 40 * in_m, 60 * in_m, 0, false},
                       {"neck", 40 * in_m, 44 * in_m, 30 * in_m, 0, false},
                       {"wheel_2", 44 * in_m, 80 * in_m, 60 * in_m, 0, false}};
         s.fillets_m = {2 * in_m, 2 * in_m};
       },
       {"neck", "4 mm long", "fillets of 2 mm and 2 mm", "95 %"}},
      {"fillet between two shoulders",
       [](Shaft& s, auto&) {
         s.fillets_m[2] = 3.4 * in_m;
         s.segments[2].end_m = s.segments[3].begin_m = -186 * in_m;
       },
       {"main_bearing_1", "5.5 mm long", "fillets of 0 mm and 3.4 mm", "60 %", "a neighbour is thinner"}},
      {"port without room",
       [](Shaft& s, auto&) {
         s.segments = {{"pin", 0, 4 * in_m, 30 * in_m, 0, true},
                       {"wheel", 4 * in_m, 40 * in_m, 60 * in_m, 0, false}};
         s.fillets_m = {2 * in_m};
       },
       {"pin", "is a port", "2 mm", "loaded zone of 0 mm"}},
      {"eccentricity beyond the neighbour",
       [](Shaft& s, auto&) { s.segments[4].eccentricity_m = 9.5 * in_m; },
       {"eccentricity of eccentric_seat", "leaves the disc", "9.5 mm", "step of 9 mm"}},
      {"eccentricity that flattens the ring",
       [](Shaft& s, auto&) { s.segments[4].eccentricity_m = 6.2 * in_m; },
       {"eccentric_seat", "6.2 mm", "90 %", "6.5 mm", "radius 23.5 mm"}},
      {"eccentric and thin",
       [](Shaft& s, auto&) { s.segments[3].eccentricity_m = 1 * in_m; },
       {"body_1", "eccentric by 1 mm", "thicker than both"}},
      {"NaN direction",
       [](Shaft& s, auto&) { s.segments[4].eccentricity_angle_rad = not_a_number; },
       {"eccentric_seat", "eccentricity_angle_rad = nan"}},
      {"alone and too eccentric",
       [](Shaft& s, auto&) {
         s = plain_cylinder();
         s.segments[0].bore_m = 20 * in_m;
         s.segments[0].eccentricity_m = 10 * in_m;
       },
       {"rod", "10 mm", "90 %", "10.5 mm", "radius 14.5 mm"}},
      {"odd cells",
       [](auto&, ShaftMeshControl& c) { c.cells_per_fillet_quarter = 3; },
       {"cells_per_fillet_quarter = 3"}},
      {"no cells",
       [](auto&, ShaftMeshControl& c) { c.cells_per_fillet_quarter = 0; },
       {"cells_per_fillet_quarter = 0"}},
      {"sectors", [](auto&, ShaftMeshControl& c) { c.n_sectors = 18; }, {"n_sectors = 18", "multiple of 4"}},
      {"subdivisions of sectors",
       [](auto&, ShaftMeshControl& c) {
         c.subdivisions = 4;
         c.n_sectors = 24;
       },
       {"subdivisions = 4", "quarter of the sectors"}},
      {"subdivisions of a fillet",
       [](auto&, ShaftMeshControl& c) {
         c.subdivisions = 2;
         c.fillet_cells = {6};
       },
       {"subdivisions = 2", "half of the cells"}},
      {"no subdivisions",
       [](auto&, ShaftMeshControl& c) { c.subdivisions = 0; },
       {"subdivisions = 0", "at least 1"}},
      {"few sectors", [](auto&, ShaftMeshControl& c) { c.n_sectors = 4; }, {"n_sectors = 4", "at least 8"}},
      {"growth", [](auto&, ShaftMeshControl& c) { c.growth = 0; }, {"growth = 0"}},
      {"steep growth",
       [](auto&, ShaftMeshControl& c) { c.growth = 1.01 * ShaftMeshControl::steepest_growth; },
       {"growth = 1.01", "at most 1"}},
      {"rows", [](auto&, ShaftMeshControl& c) { c.rows_factor = 0.5; }, {"rows_factor = 0.5", "at least 1"}},
      {"largest cell", [](auto&, ShaftMeshControl& c) { c.largest_cell_m = -1; }, {"largest_cell_m = -1"}},
      {"wanted quality",
       [](auto&, ShaftMeshControl& c) { c.min_scaled_jacobian = 1.5; },
       {"min_scaled_jacobian = 1.5"}},
  };
}

}  // namespace

void expect_refused(const std::vector<Refusal>& refusals) {
  for (const auto& refusal : refusals) {
    SCOPED_TRACE(refusal.what);
    Shaft shaft = laboratory_shaft();
    ShaftMeshControl control;
    refusal.spoil(shaft, control);
    try {
      meshes::build_shaft(shaft, control);
      ADD_FAILURE() << "was meshed";
    } catch (const std::invalid_argument& error) {
      for (const auto& part : refusal.expected)
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
            << error.what() << "\nlacks: " << part;
    }
  }
}

namespace {

TEST(RefusedShafts, AreRefusedWithTheNumbersAndTheRemedy) {
  expect_refused(refusals());
}

/// A limit of quality above what the shaft reaches: the message names the value and the place.
TEST(RefusedShafts, NameTheWorstCell) {
  ShaftMeshControl control;
  control.min_scaled_jacobian = 0.95;
  try {
    meshes::build_shaft(laboratory_shaft(), control);
    ADD_FAILURE() << "was meshed";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    for (const std::string part : {"scaled Jacobian is 0.6", "(x, y, z)", "wanted 0.95", "fillet"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace
