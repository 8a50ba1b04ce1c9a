// Welds of a user's own part: hot-spot stress where the scene calls a sharp inner edge a weld.
#include <gmsh.h>

#include "tests/cases/program/program.h"
#include "tests/cases/program/step_shafts.h"

using namespace cases;

namespace {

namespace occ = gmsh::model::occ;

constexpr double force_N = 3000, arm_mm = 50, width_mm = 40, plate_mm = 12;

/// An upright of 12 mm on a base of 100 x 12 x 40 mm, pulled sideways 50 mm above the base; `edges` are its
/// `[[part.edges]]`.
fs::path tee(const fs::path& directory, const std::string& edges) {
  step_shafts::write_drawn(directory / "tee.step", [] {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addBox(-50, 0, 0, 100, 12, 40)}}, {{3, occ::addBox(-6, 12, 0, 12, 50, 40)}}, result,
              map);
    occ::synchronize();
  });
  return write(directory / "tee.toml", R"(effects = ["pull"]
[machine]
type = "load_table"
speed = "600 rpm"
constants = [{ effect = "pull", load = "top.fx", value = "3 kN" }]
[sampling]
instants_per_turn = 12
turns = 1
[results]
snapshots = 0
pictures = false
[part]
file = "tee.step"
clamp = "foot"
[[part.ports]]
port = "top"
box = { low = ["-7 mm", "61.9 mm", "-1 mm"], high = ["7 mm", "62.1 mm", "41 mm"] }
[[part.ports]]
port = "foot"
box = { low = ["-51 mm", "-0.1 mm", "-1 mm"], high = ["51 mm", "0.1 mm", "41 mm"] }
)" + edges + steel_of("part"));
}

}  // namespace

// The plate beside the weld bends as a beam: 6 F a / (b t^2) at the toe, a straight line up to it. Poisson's
// ratio holds a plate three times as wide as thick narrower: its middle has 2 % more, its rims less. Turns
// red: toes of the base, stress of the sharp corner itself, points at other distances (4 % for each 0.2 t).
TEST(WeldsOfParts, HotSpotIsTheBendingOfThePlate) {
  const results_test::Directory directory;
  tee(directory.path, R"(
[[part.edges]]
at = ["-6 mm", "12 mm", "20 mm"]
kind = "weld"
thickness = "12 mm"
)");
  const auto run = as_a_user(directory.path, "run tee.toml -o r");
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const auto body = summary(directory / "r")["bodies"]["part"];
  const auto& first = body["hot_spots"][0];
  const double bending_Pa = 6 * force_N * arm_mm / (width_mm * plate_mm * plate_mm) * 1e6;
  EXPECT_NEAR(first["normal_max_Pa"].get<double>(), bending_Pa, 0.05 * bending_Pa) << first;
  EXPECT_LE(std::abs(first["normal_max_Pa"].get<double>() - bending_Pa),
            first["error"]["numerical"].get<double>() + 0.03 * bending_Pa);
  EXPECT_TRUE(fs::exists(directory / "r/part/hot_spots.csv"));
}

// A part that nothing was said of is told how: with the table that it prints the run judges the weld.
TEST(WeldsOfParts, ARiseTowardsAnEdgeSaysWhatToWrite) {
  const results_test::Directory directory;
  tee(directory.path, "");
  const auto run = millstress(directory.path, "run tee.toml -o r");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto told = run.out.find("SHARP EDGE: ");
  ASSERT_NE(told, std::string::npos) << run.out;
  const auto from = run.out.find("at = [", told), to = run.out.find(']', from);
  ASSERT_NE(to, std::string::npos) << run.out;
  tee(directory.path, "\n[[part.edges]]\n" + run.out.substr(from, to + 1 - from) +
                          "\nkind = \"weld\"\nthickness = \"12 mm\"\n");
  const auto again = millstress(directory.path, "run tee.toml -o r");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out.find("SHARP EDGE: "), std::string::npos) << again.out;
  EXPECT_FALSE(summary(directory / "r")["bodies"]["part"]["hot_spots"].empty());
}
