// Bars from STEP files, of which statics know the stress.
#include <fmt/core.h>
#include <gmsh.h>

#include <cmath>

#include "tests/cases/program/program.h"
#include "tests/cases/program/step_shafts.h"

using namespace cases;

namespace {

// The stress of bending is largest at the outer fibre, end faces included: none of the submodels that tell a
// mesh's error may keep away from where the moment enters. Beside the end the recovered stress of these cells
// is 0.3 to 0.6 % too high, which single cells took for 0.2 to 0.5 %.
TEST(ImportedBody, TheErrorBesideALoadedFaceIsKnown) {
  struct Bar {
    double radius_mm, length_mm;
    const char* mesh;
  };
  for (const Bar& bar :
       {Bar{14, 200, "size = \"6 mm\"\n"}, Bar{10, 40, "cells_per_circle = 20\nsize = \"3 mm\"\n"},
        Bar{14, 200, "size = \"12 mm\"\ncells_per_circle = 10\n"}}) {
    const results_test::Directory directory;
    step_shafts::write_drawn(directory / "bar.step", [&] {
      gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, bar.length_mm, bar.radius_mm);
      gmsh::model::occ::synchronize();
    });
    const double known_Pa = 100e6,
                 moment_Nm = known_Pa * std::acos(-1.0) / 4 * std::pow(1e-3 * bar.radius_mm, 3);
    std::string text = R"(title = "A bar under pure bending"
effects = ["load"]

[machine]
type = "load_table"
speed = "600 rpm"
)" + step_shafts::one_turn(8) +
                       R"(
[part]
file = "bar.step"
)";
    for (const bool far : {false, true}) {
      const auto name = far ? "far" : "near";
      const double z_mm = far ? bar.length_mm : 0;
      text += step_shafts::box_port(name, {-50, -50, z_mm - 0.1}, {50, 50, z_mm + 0.1});
      text += fmt::format("[[machine.constants]]\neffect = \"load\"\nload = \"{}.mx\"\nvalue = \"{} N m\"\n",
                          name, far ? moment_Nm : -moment_Nm);
    }
    write(directory / "bar.toml", text + "[part.mesh]\n" + bar.mesh + steel_of("part"));
    const auto outcome = millstress(directory.path, "run bar.toml -o out --tolerance none");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = summary(directory / "out");
    const auto& at = json["bodies"]["part"]["peak_von_mises"];
    EXPECT_NEAR(at["value"].get<double>(), known_Pa, at["error"]["numerical"].get<double>()) << text;
    EXPECT_LT(at["error"]["numerical"].get<double>(), 0.02 * known_Pa) << text;
    EXPECT_TRUE(json["timing"].contains("errors"))
        << "the submodels' seconds are missing: " << json["timing"];
  }
}

}  // namespace
