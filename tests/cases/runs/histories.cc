// Stress over the cycle as `millstress history` writes it: closed forms, what the run itself has written, and
// what is refused.
#include <algorithm>
#include <cmath>

#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

Json history(const fs::path& directory, const std::string& arguments) {
  const auto run = millstress(directory, "history scene.toml --json " + arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? Json::parse(run.out) : Json();
}

/// As a solid: a beam keeps no unit responses.
std::string solid_shaft(const std::vector<SmallLoad>& loads) {
  return "method = \"solid\"\n" + small_shaft(loads, "mm", "600 rpm", "");
}

/// A constant force in space, in the middle of a shaft that turns.
std::string bent_shaft() {
  return solid_shaft(fixed_in_space("pull", "middle", "100 N"));
}

std::string refusal(const fs::path& directory, const std::string& arguments) {
  const auto run = millstress(directory, "history " + arguments);
  EXPECT_EQ(run.exit_code, 2) << arguments << run.out;
  return run.err;
}

/// Half the von Mises stress of the difference of the two rows that differ most.
double amplitude_MPa(const std::map<std::string, std::vector<double>>& table) {
  const auto n = table.at("xx").size();
  double most = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto d = [&](const char* name) { return table.at(name)[i] - table.at(name)[j]; };
      const double squared =
          (std::pow(d("xx") - d("yy"), 2) + std::pow(d("yy") - d("zz"), 2) + std::pow(d("zz") - d("xx"), 2)) /
              2 +
          3 * (std::pow(d("xy"), 2) + std::pow(d("yz"), 2) + std::pow(d("xz"), 2));
      most = std::max(most, std::sqrt(squared) / 2);
    }
  return most;
}

}  // namespace

// M = F/2 from the bearing's middle on, sigma = 32 M / (pi d^3) on the surface; reversed within half a turn.
TEST(Histories, AForceFixedInSpaceIsRotatingBending) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  const auto json = history(directory.path, "--at '5, 0, 102 mm' -o h");
  ASSERT_EQ(json["points"].size(), 1u);
  const auto& point = json["points"][0];
  const double x_m = point["position_m"][0], z_m = point["position_m"][2];
  EXPECT_NEAR(z_m, 0.102, 0.012) << "the nearest node";
  const auto table = csv(directory / ("h/" + point["file"].get<std::string>()));
  const auto& zz = table.at("zz");
  ASSERT_EQ(zz.size(), 24u);
  const double amplitude = *std::max_element(zz.begin(), zz.end());
  const double bending_MPa = 50 * (z_m - 0.002) * x_m / (M_PI * std::pow(0.01, 4) / 64) / 1e6;
  EXPECT_NEAR(amplitude, bending_MPa, 0.02 * bending_MPa);  // eight cells around
  EXPECT_NEAR(point["amplitude_Pa"].get<double>() / 1e6, amplitude_MPa(table), 1e-9 * amplitude);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR(table.at("drive_angle")[i], 15. * double(i), 1e-9);
    EXPECT_NEAR(table.at("time")[i], 0.1 * double(i) / 24, 1e-12);
    // Half the circumference carries the pressure: its even part does not turn back, and dies out from the
    // seat.
    EXPECT_NEAR(zz[i], -zz[(i + 12) % 24], 1e-5 * amplitude);
    const auto of = [&](const char* name) { return table.at(name)[i]; };
    const double von_mises =
        std::sqrt((std::pow(of("xx") - of("yy"), 2) + std::pow(of("yy") - of("zz"), 2) +
                   std::pow(of("zz") - of("xx"), 2)) /
                      2 +
                  3 * (std::pow(of("xy"), 2) + std::pow(of("yz"), 2) + std::pow(of("xz"), 2)));
    EXPECT_NEAR(of("von_mises"), von_mises, 1e-12 * amplitude);
    EXPECT_NEAR(std::abs(of("signed_von_mises")), von_mises, 1e-12 * amplitude);
    if (std::abs(zz[i]) > 0.1 * amplitude) {
      EXPECT_EQ(of("signed_von_mises") > 0, zz[i] > 0) << i;
    }
    const double trace = of("xx") + of("yy") + of("zz");
    EXPECT_NEAR(of("principal_1") + of("principal_2") + of("principal_3"), trace, 1e-12 * amplitude);
    EXPECT_GE(of("principal_1"), of("principal_2"));
    EXPECT_GE(of("principal_2"), of("principal_3"));
  }
}

// Harmonics around the axis keep their responses too, also where a solid has left its own before. Red if they
// are not kept, or if the solid's are taken for them. M = F/2 from the bearing's middle on, as above; away
// from seats and fillets the section has no error but that of its cells of degree 3.
TEST(Histories, HarmonicsAroundTheAxisHaveThem) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  ASSERT_EQ(millstress(directory.path, "run scene.toml --tolerance none").exit_code, 0);
  const auto json = history(directory.path,
                            "--method axisymmetric --tolerance none -o h --at '5, 0, 102 mm' --at 'zone 1'");
  ASSERT_EQ(json["points"].size(), 2u);
  const auto run = summary(directory / "results/scene")["bodies"]["shaft"];
  EXPECT_EQ(run["method"], "axisymmetric");
  const double peak_Pa = run["zones"][0]["peak_von_mises_Pa"];
  EXPECT_NEAR(json["points"][1]["von_mises_max_Pa"].get<double>(), peak_Pa, 1e-9 * peak_Pa);
  const auto& point = json["points"][0];
  const double x_m = point["position_m"][0], z_m = point["position_m"][2];
  EXPECT_NEAR(x_m, 0.005, 1e-9);
  const auto table = csv(directory / ("h/" + point["file"].get<std::string>()));
  const auto& zz = table.at("zz");
  const double bending_MPa = 50 * (z_m - 0.002) * x_m / (M_PI * std::pow(0.01, 4) / 64) / 1e6;
  EXPECT_NEAR(*std::max_element(zz.begin(), zz.end()), bending_MPa, 1e-3 * bending_MPa);
}

// Zones by default: at the instant of its peak a zone's history is the tensor that the run wrote.
TEST(Histories, ZonesHaveTheTensorOfTheRun) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        solid_shaft({{"pull", "middle.fy", "100 N"}, {"twist", "middle.torque", "3 N m", 2}}));
  const auto json = history(directory.path, "-o h");
  const auto zones = csv(directory / "results/scene/shaft/zones.csv");
  const auto n_zones = zones.at("zone").size();
  ASSERT_GE(n_zones, 1u);
  ASSERT_EQ(json["points"].size(), n_zones);
  const auto groups = results_test::bytes(directory / "h/histories.h5");
  EXPECT_NE(groups.find("zone_1"), std::string::npos) << "the group has the name of the table";
  EXPECT_NE(groups.find("zone 1"), std::string::npos) << "its attribute that of the point";
  for (std::size_t k = 0; k < n_zones; ++k) {
    const auto table = csv(directory / ("h/" + json["points"][k]["file"].get<std::string>()));
    const double peak = zones.at("peak_von_mises")[k];
    const auto& von_mises = table.at("von_mises");
    EXPECT_NEAR(*std::max_element(von_mises.begin(), von_mises.end()), peak, 1e-9 * peak);
    const auto i = std::size_t(std::lround(zones.at("drive_angle")[k] / 15));
    for (const std::string component : {"xx", "yy", "zz", "xy", "yz", "xz"})
      EXPECT_NEAR(table.at(component)[i], zones.at("sigma_" + component)[k], 1e-9 * peak) << component;
  }
}

// A shoulder without a fillet: the run leaves out what is beside its edge, and a history there says so. Red
// if a stress that no mesh makes converge stands without a word.
TEST(Histories, BesideSharpEdgesSayThatNoneConverges) {
  const results_test::Directory directory;
  write(directory / "scene.toml", R"(method = "solid"
effects = ["pull"]
[machine]
type = "load_table"
speed = "600 rpm"
constants = [{ effect = "pull", load = "middle.fx", value = 500 }]
[sampling]
instants_per_turn = 8
[shaft]
contour = [{ port = "left", diameter = "20 mm", length = "20 mm" },
           { port = "middle", diameter = "30 mm", length = "40 mm" },
           { port = "right", diameter = "20 mm", length = "20 mm" }]
bearings = ["left", "right"]
mesh = { sectors = 8 }
[shaft.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "300 MPa"
)");
  const auto json = history(directory.path, "--at '10, 0, 20 mm' --at '15, 0, 40 mm' -o h");
  ASSERT_EQ(json["points"].size(), 2u);
  EXPECT_EQ(json["points"][0]["left_out"], true);
  EXPECT_EQ(json["points"][1]["left_out"], false);
  const auto run = millstress(directory.path, "history scene.toml --at '10, 0, 20 mm' -o h");
  EXPECT_NE(run.out.find("shaft, 10, 0, 20 mm: beside a sharp edge"), std::string::npos) << run.out;
}

TEST(Histories, ArePutOutWithoutAnotherRunIfNothingHasChanged) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  ASSERT_EQ(millstress(directory.path, "history scene.toml -o h").exit_code, 0);
  const auto before = results_test::bytes(directory / "results/scene/summary.json");
  const auto again =
      millstress(directory.path, "history scene.toml -o h --at 'shaft/zone 1' --at middle --at 'node 7'");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("unchanged since the last run"), std::string::npos) << again.err;
  EXPECT_EQ(results_test::bytes(directory / "results/scene/summary.json"), before) << "seconds would differ";
  for (const char* file : {"shaft_zone_1.csv", "shaft_middle.csv", "shaft_node_7.csv"})
    EXPECT_TRUE(fs::exists(directory / ("h/" + std::string(file)))) << file << again.out;
  for (const char* part : {"zone 1", "middle", "node 7", "von Mises MPa", "histories.h5"})
    EXPECT_NE(again.out.find(part), std::string::npos) << part;
}

TEST(Histories, RefuseWhatIsNoPointAndFilesOfAnotherRun) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  for (const char* at :
       {"zone 0", "zone 99", "node 99999999", "nowhere", "1, 2 mm", "1, 2, 3", "shaft/other"}) {
    const auto text = refusal(directory.path, "scene.toml -o h --at '" + std::string(at) + "'");
    EXPECT_NE(text.find("is no point of the run"), std::string::npos) << at << text;
    EXPECT_NE(text.find("middle"), std::string::npos) << "names those that are: " << text;
  }
  // Beside the body: the bar's radius is 5 mm, its largest cell 20 mm long.
  const auto beside = refusal(directory.path, "scene.toml -o h --at '1e9, 0, 0 mm'");
  EXPECT_NE(beside.find("is 1e+09 mm from the nearest node of the shaft"), std::string::npos) << beside;
  EXPECT_NE(refusal(directory.path, "scene.toml -o h --at 'midle'").find("\"middle\""), std::string::npos);
  EXPECT_FALSE(fs::exists(directory / "h"));
  const auto inside = millstress(directory.path, "history scene.toml -o g --json --at '0.1, 0, 102 mm'");
  ASSERT_EQ(inside.exit_code, 0) << inside.err;
  const auto near = Json::parse(inside.out)["points"][0];
  const auto& at_m = near["position_m"];
  const double distance_m =
      std::hypot(at_m[0].get<double>() - 1e-4, at_m[1].get<double>(), at_m[2].get<double>() - 0.102);
  EXPECT_GT(distance_m, 0);
  EXPECT_NEAR(near["distance_m"].get<double>(), distance_m, 1e-12) << near;
  write(directory / "taken", "a file");
  EXPECT_NE(refusal(directory.path, "scene.toml -o taken").find("taken"), std::string::npos);
  EXPECT_NE(refusal(directory.path, "'" + shipped("drive_train.toml").string() + "' -o h").find("no body"),
            std::string::npos);

  // Loads of another run in the directory: they are not the run's, and stop it; gone, they are made anew.
  const auto own = results_test::bytes(directory / "results/scene/loads.h5");
  write(directory / "other.toml", with_edits(bent_shaft(), {{"load = \"middle.fx\"\namplitude = \"100 N\"",
                                                             "load = \"middle.fx\"\namplitude = \"90 N\""}}));
  ASSERT_EQ(millstress(directory.path, "run other.toml -o other").exit_code, 0);
  fs::copy_file(directory / "other/loads.h5", directory / "results/scene/loads.h5",
                fs::copy_options::overwrite_existing);
  EXPECT_NE(refusal(directory.path, "scene.toml -o h --at 'zone 1'").find("results/scene/loads.h5: is there"),
            std::string::npos);
  fs::remove(directory / "results/scene/loads.h5");
  const auto json = history(directory.path, "-o h --at 'zone 1'");
  EXPECT_EQ(results_test::bytes(directory / "results/scene/loads.h5"), own);
  EXPECT_NEAR(
      json["points"][0]["von_mises_max_Pa"].get<double>(),
      summary(directory / "results/scene")["bodies"]["shaft"]["zones"][0]["peak_von_mises_Pa"].get<double>(),
      1);
}

// Red if what a solid left in the directory is taken for the responses of the beam that came after it, or if
// another run replaces one with options of its own.
TEST(Histories, AreOfTheRunThatIsAskedFor) {
  const results_test::Directory directory;
  write(directory / "scene.toml", bent_shaft());
  ASSERT_EQ(millstress(directory.path, "run scene.toml --tolerance none --method solid").exit_code, 0);
  const auto own = results_test::bytes(directory / "results/scene/summary.json");
  const auto kept = millstress(directory.path, "history scene.toml -o h --tolerance none --method solid");
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_EQ(results_test::bytes(directory / "results/scene/summary.json"), own) << "not run again";
  EXPECT_TRUE(fs::exists(cached_responses(directory.path, "results/scene")));
  const auto text = refusal(directory.path, "scene.toml -o none --tolerance none --method beam");
  EXPECT_NE(text.find("shaft: a beam keeps no unit responses; --method solid does"), std::string::npos)
      << text;
  EXPECT_FALSE(fs::exists(directory / "none"));
}

// Harmonics keep their unit responses beside those of a solid. Red if one takes the other's place: the solid
// would be solved again, or a history would be of the other model. What the cache has lost is computed again.
TEST(Histories, HarmonicsLeaveASolidsResponses) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", ""));
  const auto run = [&](const std::string& method) {
    const auto outcome = millstress(directory.path, "run scene.toml --tolerance none --method " + method);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return summary(directory / "results/scene")["bodies"]["shaft"]["peak_von_mises"]["value"].get<double>();
  };
  const double solid_Pa = run("solid");
  const auto kept = cached_responses(directory.path, "results/scene");
  const auto before = fs::last_write_time(kept);
  const double harmonics_Pa = run("axisymmetric");
  const auto harmonics = cached_responses(directory.path, "results/scene");
  EXPECT_TRUE(fs::remove(harmonics));
  const auto json = history(directory.path, "--tolerance none --method axisymmetric");
  EXPECT_TRUE(fs::exists(harmonics));
  EXPECT_NEAR(json["points"][0]["von_mises_max_Pa"].get<double>(), harmonics_Pa, 1e-9 * harmonics_Pa);
  EXPECT_EQ(run("solid"), solid_Pa);
  EXPECT_EQ(fs::last_write_time(kept), before) << "taken, not solved again";
}

// The toes' stress is extrapolated from two nodes; the run's range across the toe is that of its tensor.
TEST(Histories, WeldToesHaveTheExtrapolatedStress) {
  const results_test::Directory directory;
  write(directory / "scene.toml", chamber_alone({{"instants_per_turn = 120", "instants_per_turn = 24"},
                                                 {"snapshots = 12", "snapshots = 0"},
                                                 {"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}}));
  const auto run = millstress(directory.path, "history scene.toml --json -o h --tolerance '40 %'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = Json::parse(run.out);
  const auto spots = summary(directory / "results/scene")["bodies"]["chamber"]["hot_spots"];
  std::size_t n_toes = 0;
  for (const auto& point : json["points"])
    for (const auto& spot : spots)
      if (spot["name"] == point["point"]) {
        ++n_toes;
        const double stated = spot["von_mises_Pa"];
        EXPECT_NEAR(point["von_mises_max_Pa"].get<double>(), stated, 1e-9 * stated);
        const auto table = csv(directory / ("h/" + point["file"].get<std::string>()));
        EXPECT_GE(*std::max_element(table.at("principal_1").begin(), table.at("principal_1").end()) * 1e6,
                  spot["normal_max_Pa"].get<double>() * (1 - 1e-9));
      }
  EXPECT_EQ(n_toes, spots.size());
  EXPECT_GE(n_toes, 2u);
}

// Bending b cos(phi) with torsion of the same von Mises stress, t cos(2 phi): half a turn later bending has
// changed its sign and torsion has not. Signed von Mises stress then goes from -sqrt(b^2 + t^2) to sqrt(b^2 +
// t^2), and half of that range is 1.26 times the amplitude, sqrt(b^2 + 4 t^2) / 2. Red with half the range of
// signed_von_mises.
TEST(Histories, TheAmplitudeNeedsNoSign) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        solid_shaft({{"pull", "middle.fy", "100 N", 1}, {"twist", "middle.torque", "11 N m", 2}}));
  const auto json = history(directory.path, "-o h");
  bool flips = false;
  for (const auto& point : json["points"]) {
    const auto table = csv(directory / ("h/" + point["file"].get<std::string>()));
    const double expected = amplitude_MPa(table), found = point["amplitude_Pa"].get<double>() / 1e6;
    EXPECT_NEAR(found, expected, 1e-8 * expected) << point["point"];
    const double signed_MPa =
        (point["signed_von_mises_max_Pa"].get<double>() - point["signed_von_mises_min_Pa"].get<double>()) /
        2e6;
    flips = flips || signed_MPa > 1.05 * found;
    const std::size_t from = point["amplitude_between_lines"][0], to = point["amplitude_between_lines"][1];
    ASSERT_LT(from, to);
    ASSERT_GE(from, 2u);
    double squared = 0;
    for (const auto& [a, b] : {std::pair{"xx", "yy"}, {"yy", "zz"}, {"zz", "xx"}})
      squared += std::pow((table.at(a)[to - 2] - table.at(b)[to - 2]) -
                              (table.at(a)[from - 2] - table.at(b)[from - 2]),
                          2) /
                 2;
    for (const char* shear : {"xy", "yz", "xz"})
      squared += 3 * std::pow(table.at(shear)[to - 2] - table.at(shear)[from - 2], 2);
    EXPECT_NEAR(std::sqrt(squared) / 2, expected, 1e-8 * expected) << "on the lines that are told";
  }
  EXPECT_TRUE(flips);
}
