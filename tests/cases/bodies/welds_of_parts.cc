// Welds of a user's own part: hot-spot stress where the scene calls a sharp inner edge a weld.
#include <gmsh.h>

#include <iterator>
#include <map>

#include "tests/cases/program/field_tables.h"
#include "tests/cases/program/program.h"
#include "tests/cases/program/step_shafts.h"

using namespace cases;

namespace {

namespace occ = gmsh::model::occ;

constexpr double force_N = 3000, arm_mm = 50, width_mm = 40, plate_mm = 12;

/// An upright of 12 mm on a base of 100 x 12 x 40 mm, pulled sideways 50 mm above the base; `edges` are its
/// `[[part.edges]]`.
fs::path tee(const fs::path& directory, const std::string& edges, const std::string& mesh = "") {
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
)" + edges + mesh + steel_of("part"));
}

}  // namespace

// The plate beside the weld bends as a beam: 6 F a / (b t^2) at the toe, a straight line up to it. On a plate
// three times as wide as thick that is the mean over its width: the middle has more, since it cannot become
// narrower, the rims less (CalculiX on cells of 2 mm, extrapolated alike: 159 and 150 MPa). Turns red: toes
// of the base (half of it), the stress beside the corner (a third more).
TEST(WeldsOfParts, HotSpotIsTheBendingOfThePlate) {
  const results_test::Directory directory;
  tee(directory.path, R"(
[[part.edges]]
at = ["-6 mm", "12 mm", "20 mm"]
kind = "weld"
thickness = "12 mm"
)");
  const auto run = millstress(directory.path, "run tee.toml -o r --tolerance none");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto body = summary(directory / "r")["bodies"]["part"];
  const double bending_Pa = 6 * force_N * arm_mm / (width_mm * plate_mm * plate_mm) * 1e6;
  std::map<double, double> upright_Pa;  // by place along the weld
  for (const auto& spot : body["hot_spots"])
    if (spot["name"].get<std::string>().find("plane x = -6 mm") != std::string::npos)
      upright_Pa[spot["position_m"][2]] = spot["normal_max_Pa"];
  ASSERT_EQ(upright_Pa.size(), 4U);
  double mean_Pa = 0;
  for (const auto& [z_m, value_Pa] : upright_Pa) mean_Pa += value_Pa / 4;
  EXPECT_NEAR(mean_Pa, bending_Pa, 0.05 * bending_Pa);
  EXPECT_GT(std::next(upright_Pa.begin())->second, upright_Pa.begin()->second) << "the middle has more";
  EXPECT_EQ(expect_fields_of_readme(directory / "r").count("hot_spots.csv"), 1u);
}

// A part that nothing was said of is told how: the table that it prints is a weld of the part.
TEST(WeldsOfParts, ARiseTowardsAnEdgeSaysWhatToWrite) {
  const results_test::Directory directory;
  const std::string mesh = "\n[part.mesh]\nsize = \"3 mm\"\n";
  tee(directory.path, "", mesh);
  const auto run = millstress(directory.path, "run tee.toml -o r");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto told = run.out.find("SHARP EDGE: ");
  ASSERT_NE(told, std::string::npos) << run.out;
  const auto from = run.out.find("at = [", told), to = run.out.find(']', from);
  ASSERT_NE(to, std::string::npos) << run.out;
  tee(directory.path,
      "\n[[part.edges]]\n" + run.out.substr(from, to + 1 - from) +
          "\nkind = \"weld\"\nthickness = \"12 mm\"\n",
      mesh);
  const auto again = millstress(directory.path, "check tee.toml --thorough");
  EXPECT_EQ(again.exit_code, 0) << again.err;
}
