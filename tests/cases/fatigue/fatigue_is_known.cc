/// How well fatigue knows what it judges by: the gradient below the surface, and the amplitude.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// The end of a scene: a shaft of steel whose fatigue is asked for, and no pictures.
std::string judged(const std::string& mesh = "") {
  return steel_of("shaft") + mesh +
         "[shaft.fatigue]\ntensile_strength = \"600 MPa\"\nroughness = \"1 um\"\n"
         "[results]\npictures = false\nsnapshots = 0\n";
}

}  // namespace

// The related gradient of a shoulder in bending is 2.3 / r by the tables of FKM and DIN 743 (d/D = 2/3), for
// the small fillet of a thick shaft, too: cells there are a tenth of a millimetre along the section and ten
// around. Turns red: a plane or quadratic in x, y, z through the nodes around, 2.8 and 3.2 instead of 4.6/mm.
TEST(Fatigue, SupportOfASmallFilletIsThatOfItsRadius) {
  const results_test::Directory directory;
  const double fillet_m = 0.5e-3;
  const std::string scene = R"(effects = "all"
[machine]
type = "load_table"
speed = "600 rpm"
harmonics = [{ effect = "pull", load = "tip.fx", amplitude = "4 kN" },
             { effect = "pull", load = "tip.fy", amplitude = "4 kN", phase = "90 deg" }]
[sampling]
instants_per_turn = 48
[shaft]
contour = [{ port = "left", diameter = "60 mm", length = "20 mm" },
           { name = "body", diameter = "60 mm", length = "100 mm" },
           { port = "right", diameter = "60 mm", length = "20 mm" },
           { name = "rest", diameter = "60 mm", length = "50 mm" }, { fillet = "0.5 mm" },
           { name = "neck", diameter = "40 mm", length = "80 mm" },
           { port = "tip", diameter = "40 mm", length = "20 mm" }]
bearings = ["left", "right"]
pressure_harmonics = 0)" + judged("[shaft.mesh]\nsectors = 8\n");
  for (const std::string method : {"axisymmetric", "solid"}) {
    const auto json =
        run_small(directory.path, "method = \"" + method + "\"\ntolerance = \"none\"\n" + scene);
    ASSERT_FALSE(json.is_null()) << method;
    const auto& place = json["bodies"]["shaft"]["fatigue"]["places"][0];
    EXPECT_EQ(place["feature"], "fillet rest/neck");
    std::printf("%s: G r = %.3f\n", method.c_str(), place["related_gradient_1_m"].get<double>() * fillet_m);
    EXPECT_NEAR(place["related_gradient_1_m"].get<double>() * fillet_m, 2.3, 0.1 * 2.3) << method;
  }
}

// Under a steady torque the largest stress of a fillet or seat is the torque's, its amplitude the bending's,
// of which a search that looks at the largest stress learns little. Against harmonics around the axis. Turns
// red: the error of the largest stress alone; of seat and fillets 3 to 20 % off it said 1 to 3 %.
TEST(Fatigue, AmplitudesHaveAnErrorOfTheirOwn) {
  const results_test::Directory directory;
  const std::string scene = R"(effects = "all"
[machine]
type = "load_table"
speed = "300 rpm"
harmonics = [{ effect = "pull", load = "load.fx", amplitude = "140 N" },
             { effect = "pull", load = "load.fy", amplitude = "140 N", phase = "90 deg" },
             { effect = "tilt", load = "b1.mx", amplitude = "0.4 N m" }]
constants = [{ effect = "drive", load = "load.torque", value = "0.9 N m" }]
[sampling]
instants_per_turn = 48
[shaft]
contour = [{ port = "flange", diameter = "14.6 mm", length = "1.3 mm" }, { fillet = "0.2 mm" },
           { port = "b1", diameter = "6 mm", length = "4 mm" }, { fillet = "0.1 mm" },
           { name = "mid", diameter = "7.3 mm", length = "9.5 mm" }, { fillet = "0.1 mm" },
           { port = "b2", diameter = "6 mm", length = "4 mm" }, { fillet = "0.1 mm" },
           { port = "load", diameter = "5.2 mm", length = "5 mm" }]
bearings = ["b1", "b2"]
torque_support = "flange")" +
                            judged();
  const auto places_by = [&](const std::string& method) {
    return run_small(directory.path, "method = \"" + method + "\"\ntolerance = \"5 %\"\n" +
                                         scene)["bodies"]["shaft"]["fatigue"]["places"];
  };
  const auto solid = places_by("solid"), harmonics = places_by("axisymmetric");
  int n = 0;
  for (const auto& place : solid) {
    const auto other = std::find_if(harmonics.begin(), harmonics.end(),
                                    [&](const auto& p) { return p["feature"] == place["feature"]; });
    ASSERT_NE(other, harmonics.end()) << place["feature"];
    const double by_solid = place["amplitude_Pa"], by_harmonics = (*other)["amplitude_Pa"];
    if (by_solid < 0.3 * solid[0]["amplitude_Pa"].get<double>()) continue;
    ++n;
    EXPECT_LE(std::abs(by_solid - by_harmonics), place["stress_error"].get<double>() * by_solid +
                                                     (*other)["stress_error"].get<double>() * by_harmonics)
        << place["feature"] << ": " << by_solid << " and " << by_harmonics;
  }
  EXPECT_GE(n, 6);
}
