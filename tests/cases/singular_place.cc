// A strip with a blunt V-notch and a round one, under tension: one stress has no value, the other one has.
#include <gmsh.h>

#include <cmath>

#include "tests/cases/program.h"

using namespace cases;

namespace {

constexpr double notch_z_m = 0.08, notch_depth_m = 0.006;

/// 2 x 20 x 240 mm; the V-notch opens by 130 degrees (less than the mesher takes for a sharp edge by itself)
/// and is 6 mm deep, the round one has a radius of 10 mm and is 4 mm deep.
void write_strip(const fs::path& step_file) {
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("strip");
  namespace occ = gmsh::model::occ;
  const double half_v = 6 * std::tan(65 * std::acos(-1.0) / 180), half_round = 8;
  const double profile[][2] = {
      {0, 0},   {0, 80 - half_v}, {6, 80}, {0, 80 + half_v}, {0, 160 - half_round}, {0, 160 + half_round},
      {0, 240}, {20, 240},        {20, 0}};
  std::vector<int> points, lines;
  for (const auto& [y, z] : profile) points.push_back(occ::addPoint(0, y, z));
  const int centre = occ::addPoint(0, -6, 160);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int from = points[i], to = points[(i + 1) % points.size()];
    lines.push_back(i == 4 ? occ::addCircleArc(from, centre, to) : occ::addLine(from, to));
  }
  gmsh::vectorpair parts;
  occ::extrude({{2, occ::addPlaneSurface({occ::addWire(lines)})}}, 2, 0, 0, parts);
  occ::synchronize();
  gmsh::write(step_file.string());
  gmsh::finalize();
}

const char* const scene = R"(title = "A strip under tension"
effects = ["pull"]
tolerance = "15 %"

[machine]
type = "load_table"
speed = "600 rpm"

[[machine.constants]]
effect = "pull"
load = "right.fz"
value = "4 kN"

[sampling]
instants_per_turn = 8
turns = 1

[results]
snapshots = 0
pictures = false

[part]
file = "strip.step"
bearings = ["left", "right"]
axial_support = "left"
torque_support = "left"

[[part.ports]]
port = "left"
box = { low = ["-1 mm", "-1 mm", "-1 mm"], high = ["3 mm", "21 mm", "1 mm"] }
[[part.ports]]
port = "right"
box = { low = ["-1 mm", "-1 mm", "239 mm"], high = ["3 mm", "21 mm", "241 mm"] }

[part.mesh]
size = "6 mm"
cells_per_circle = 16

[part.material]
name = "C45+N"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)";

}  // namespace

// The notch's stress grows like a power of the cell size: the run says so, leaves the whole edge out, and
// ends with a peak elsewhere that is known to the tolerance.
TEST(SingularPlace, IsLeftOutAndTheSearchGoesOn) {
  const results_test::Directory directory;
  write_strip(directory / "strip.step");
  write(directory / "strip.toml", scene);
  const auto run = millstress(directory.path, "run strip.toml -o out");
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_NE(run.out.find("grows with every refinement"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("around the edge through"), std::string::npos) << run.out;
  const auto part = summary(directory / "out")["bodies"]["part"];
  EXPECT_TRUE(part["search"]["met"].get<bool>());
  const auto& peak = part["peak_von_mises"];
  const double y = peak["position_m"][1], z = peak["position_m"][2];
  const double excluded_m = part["singular"].back()["excluded_within_m"];
  EXPECT_GE(std::hypot(y - notch_depth_m, z - notch_z_m), 0.999 * excluded_m);
  // The mean over the net section at the round notch is 125 MPa, at the V-notch 143 MPa.
  EXPECT_GT(peak["value"].get<double>(), 143e6);
}
