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

// The related gradient of the normal stress at a shoulder in bending is 2.3 (1 + phi) / r by the tables of
// FKM and DIN 743 (d/D = 2/3), phi 0.05, for the small fillet of a thick shaft, too. Von Mises stress falls
// faster: below a free surface the normal stress across it rises by sigma / r, which with a hoop stress of nu
// sigma brings (1 + nu) / (2 (1 - nu + nu^2)) / r = 0.82 / r. What lies between is right; coarse cells, here
// a tenth of a millimetre, tell a tenth less than the table. Turns red: a plane or quadratic in x, y, z
// through the nodes around, 2.8 and 3.2 instead of 4.6/mm.
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
    const double related = place["related_gradient_1_m"].get<double>() * fillet_m, of_table = 2.3;
    EXPECT_GT(related, 0.9 * of_table) << method;
    EXPECT_LT(related, of_table * 1.05 + 0.82) << method;
    // The neck of 60 mm by FKM's K_d (tests/unit/pipelines/base/fatigue/size_factors_of_fkm.cc), and what the
    // run with that factor comes to. Turns red: the diameter of another segment, R_m alone scaled and not
    // what follows.
    const std::string strength = json["bodies"]["shaft"]["fatigue_strength"];
    EXPECT_NE(strength.find("K_d at d_eff 60 mm would be 0.978 for structural steel (sample 40 mm)"),
              std::string::npos)
        << strength;
    const auto told = strength.find("0.857 for quenched and tempered steel (sample 16 mm): safety ");
    ASSERT_NE(told, std::string::npos) << strength;
    if (method == "solid") continue;
    auto sized = scene;
    const std::string key = "roughness = \"1 um\"\n";
    sized.replace(sized.find(key), key.size(), key + "size_factor = 0.857\n");
    const auto with_key =
        run_small(directory.path, "method = \"" + method + "\"\ntolerance = \"none\"\n" + sized);
    const auto& first = with_key["bodies"]["shaft"]["fatigue"]["places"][0];
    EXPECT_EQ(first["feature"], "fillet rest/neck");
    const double safety = std::stod(strength.substr(strength.find("safety ", told) + 7));
    EXPECT_NEAR(safety, first["safety_against_endurance"].get<double>(), 0.006) << "two decimals are told";
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

// Shigley, example 6-9: a rotating shaft of cold-drawn steel under 6.8 kN, 32 mm at the shoulder of 38 mm
// with a fillet of 3 mm: nominal stress 216 MPa, factor 1.65; the book has a factor of safety of 0.70 and
// 68,000 cycles, with size, surface and survival in its limit. At its own size, with 50 % survival and no
// safety factor, it endures here: what that takes for granted is told first, and lowered by the factor that
// is offered.
TEST(Fatigue, ATextbookShaftSaysFirstWhichSizeItsStrengthIsFor) {
  const results_test::Directory directory;
  std::string out;
  const auto json = run_small(directory.path, R"(method = "axisymmetric"
effects = "all"
[machine]
type = "load_table"
speed = "600 rpm"
harmonics = [{ effect = "force", load = "c.fx", amplitude = "6.8 kN" },
             { effect = "force", load = "c.fy", amplitude = "6.8 kN", phase = "90 deg" }]
[sampling]
instants_per_turn = 24
[shaft]
contour = [{ port = "a", diameter = "30 mm", length = "20 mm" }, { fillet = "0.5 mm" },
           { name = "ab", diameter = "32 mm", length = "240 mm" }, { fillet = "2.9 mm" },
           { name = "bc", diameter = "38 mm", length = "65 mm" },
           { port = "c", diameter = "38 mm", length = "20 mm" },
           { name = "e", diameter = "38 mm", length = "15 mm" }, { fillet = "2.9 mm" },
           { name = "f", diameter = "32 mm", length = "190 mm" }, { fillet = "0.5 mm" },
           { port = "d", diameter = "30 mm", length = "20 mm" }]
bearings = ["a", "d"]
pressure_harmonics = 0
[shaft.material]
name = "1050 CD"
youngs_modulus = "207 GPa"
poisson_ratio = 0.29
density = "7800 kg/m3"
yield_strength = "580 MPa"
[shaft.fatigue]
tensile_strength = "690 MPa"
safety_factor = 1
reliability = "50 %"
[results]
pictures = false
snapshots = 0
)",
                              &out);
  ASSERT_FALSE(json.is_null());
  const auto& shaft = json["bodies"]["shaft"];
  const auto& fatigue = shaft["fatigue"];
  const auto places = fatigue["places"];
  const auto shoulder = std::find_if(places.begin(), places.end(),
                                     [](const auto& p) { return p["feature"] == "fillet ab/bc"; });
  ASSERT_NE(shoulder, places.end());
  const double nominal_Pa = 695.5 / (M_PI * std::pow(0.032, 3) / 32);
  EXPECT_NEAR((*shoulder)["amplitude_Pa"].get<double>() / nominal_Pa, 1.55, 0.15)
      << "von Mises stress is up to a tenth below the principal one of the chart";
  EXPECT_GT((*shoulder)["safety_against_endurance"].get<double>(), 1);
  const auto line = out.find("fatigue strength: R_m 690 MPa, taken as that of the part at its size");
  ASSERT_NE(line, std::string::npos) << out;
  EXPECT_LT(out.find("R_m taken as that of the part at its size"), line) << "in the verdict, first of all";
  const auto told = out.substr(line, out.find('\n', line) - line);
  std::printf("%s\n", told.c_str());
  EXPECT_NE(told.find("survival 50 %"), std::string::npos) << told;
  // (1 - 0.23058 lg(38 / 7.5)) / (1 - 0.23058 lg(16 / 7.5)) = 0.8375 / 0.9241
  EXPECT_NE(told.find("0.906 for quenched and tempered steel (sample 16 mm): safety "), std::string::npos)
      << told;
  EXPECT_NE(told.find("set size_factor = 0.906 in [shaft.fatigue]"), std::string::npos) << told;
}
