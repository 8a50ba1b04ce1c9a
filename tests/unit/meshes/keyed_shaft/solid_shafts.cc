// Shafts with keyways as quadratic tetrahedra.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft/shaft.h"
#include "meshes/values/constants.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/shaft_volume.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

using meshes::Keyway;
using meshes::pi;
using meshes::SolidControl;

meshes::Shaft keyed_shaft(double bore_m = 0) {
  meshes::Shaft shaft;
  shaft.segments = {{"pulley", 0, 0.06, 0.04, 0, true, 0, bore_m, ""},
                    {"body", 0.06, 0.14, 0.05, 0, false, 0, bore_m, bore_m > 0 ? "hole" : ""},
                    {"bearing", 0.14, 0.18, 0.03, 0, true, 0, bore_m, ""}};
  shaft.fillets_m = {0.003, 0};
  return shaft;
}

meshes::Shaft eccentric_shaft() {
  meshes::Shaft shaft;
  shaft.segments = {{"bearing_1", 0, 0.04, 0.03, 0, true, 0, 0, ""},
                    {"body", 0.04, 0.08, 0.036, 0, false, 0, 0, ""},
                    {"seat", 0.08, 0.12, 0.05, 0.002, true, 0, 0, ""},
                    {"bearing_2", 0.12, 0.17, 0.032, 0, true, 0, 0, ""}};
  shaft.fillets_m = {0.002, 0.003, 0.004};
  return shaft;
}

constexpr int n_around = 10;  // cells: coarse, for speed
SolidControl coarse() {
  SolidControl control;
  control.cells_per_circle = n_around;
  return control;
}

/// Area that a slot of width w and depth d takes from a disc of radius R: by quadrature, no geometry kernel.
double slot_area(double radius_m, double width_m, double depth_m) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = width_m * ((i + 0.5) / n - 0.5);
    sum += (std::sqrt(radius_m * radius_m - x * x) - (radius_m - depth_m)) * width_m / n;
  }
  return sum;
}

/// With round ends the length at a place across is shorter by w - sqrt(w^2 - 4 x^2).
double slot_volume(double radius_m, const Keyway& key) {
  if (!key.round_ends) return key.length_m * slot_area(radius_m, key.width_m, key.depth_m);
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = key.width_m * ((i + 0.5) / n - 0.5);
    const double length_m = key.length_m - key.width_m + std::sqrt(key.width_m * key.width_m - 4 * x * x);
    sum += length_m * (std::sqrt(radius_m * radius_m - x * x) - (radius_m - key.depth_m)) * key.width_m / n;
  }
  return sum;
}

TEST(SolidShaft, WithoutKeywaysIsTheShaftOfTheBlocks) {
  for (const auto& shaft : {eccentric_shaft(), sharp_eccentric_shaft()}) {
    const auto solid = meshes::build_solid_shaft(shaft, {}, coarse());
    const auto blocks = meshes::build_shaft(shaft, {});
    ASSERT_EQ(solid.ports.size(), blocks.ports.size());
    for (std::size_t p = 0; p < solid.ports.size(); ++p) {
      const auto &a = solid.ports[p], &b = blocks.ports[p];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(int(a.kind), int(b.kind));
      EXPECT_DOUBLE_EQ(a.begin_m, b.begin_m);
      EXPECT_DOUBLE_EQ(a.end_m, b.end_m);
      EXPECT_DOUBLE_EQ(a.radius_m, b.radius_m);
      EXPECT_DOUBLE_EQ(a.axis_x_m, b.axis_x_m);
      EXPECT_NEAR(a.axis_y_m, b.axis_y_m, 1e-15);
    }
    ASSERT_EQ(solid.features.size(), blocks.features.size());
    for (std::size_t f = 0; f < solid.features.size(); ++f) {
      EXPECT_EQ(solid.features[f].name, blocks.features[f].name);
      EXPECT_EQ(int(solid.features[f].kind), int(blocks.features[f].kind));
    }
    const auto read = read_tetrahedra(solid);
    EXPECT_NEAR(read.volume_m3 / true_volume(shaft), 1, 1.2 * lost_by_parabolas(n_around));
    for (const auto& feature : solid.features) {
      EXPECT_GT(read.area_of.at(feature.name), 0) << feature.name;
      EXPECT_EQ(read.ids.at(feature.name), feature.boundary_id);
      for (const auto& x : read.nodes_of.at(feature.name)) {
        ASSERT_GT(x[2], feature.begin_m - 1e-9) << feature.name;
        ASSERT_LT(x[2], feature.end_m + 1e-9) << feature.name;
      }
    }
  }
}

TEST(SolidShaft, NodesLieOnCylindersAndFillets) {
  const auto shaft = keyed_shaft();
  const auto read = read_tetrahedra(
      meshes::build_solid_shaft(shaft, {{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, true}}, coarse()));
  for (const auto& x : read.nodes_of.at("pulley")) ASSERT_NEAR(std::hypot(x[0], x[1]), 0.02, 1e-10);
  for (const auto& x : read.nodes_of.at("fillet pulley/body"))
    ASSERT_NEAR(std::hypot(std::hypot(x[0], x[1]) - 0.023, x[2] - 0.057), 0.003, 1e-10);
  // The seat less the slot's opening, an arc of asin(6/20) to both sides over 30 mm less the round ends.
  EXPECT_LT(read.area_of.at("pulley"), 0.97 * 2 * pi * 0.02 * 0.054);
  double highest = -1;
  for (const auto& x : read.nodes_of.at("keyway pulley"))
    highest = std::max(highest, std::cos(0.3) * x[0] + std::sin(0.3) * x[1]);
  EXPECT_NEAR(highest, 0.02, 0.001);  // at the angle asked for
}

TEST(SolidShaft, KeywaysTakeTheirVolume) {
  for (const bool round_ends : {false, true}) {
    const double bore_m = round_ends ? 0 : 0.01;
    const auto shaft = keyed_shaft(bore_m);
    const std::vector<Keyway> keys = {{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, round_ends},
                                      {"body", 0.014, 0.0055, 0.04, 0.08, -2, round_ends}};
    const auto body = meshes::build_solid_shaft(shaft, keys, coarse());
    const double exact = true_volume(shaft) - slot_volume(0.02, keys[0]) - slot_volume(0.025, keys[1]);
    EXPECT_NEAR(read_tetrahedra(body).volume_m3 / exact, 1, 1.2 * lost_by_parabolas(n_around));
    EXPECT_GT(body.quality.min_scaled_jacobian, 0.05);
    EXPECT_GT(body.quality.max_aspect, 1);
    // The floors' edges and the sharp shoulder are re-entrant, the edges at the surface are not.
    std::vector<std::string> names;
    for (const auto& edge : body.sharp_edges) names.push_back(edge.name);
    const std::vector<std::string> expected = {"bearing/shoulder body/bearing", "keyway body/keyway body",
                                               "keyway pulley/keyway pulley"};
    EXPECT_EQ(names, expected);
  }
}

// A keyway elsewhere does not change what is left out beside a shoulder without a fillet: 0.1 of the smaller
// diameter, 3 mm, as on blocks. Elsewhere it is 1 % of the diagonal of a box with the shaft's radius of
// gyration, and an exclusion that was asked for holds everywhere.
TEST(SolidShaft, LeavesOutAtShouldersWhatBlocksLeaveOut) {
  const auto shaft = keyed_shaft();
  const Keyway key{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, true};
  const auto blocks = meshes::build_shaft(shaft, {}).sharp_edges;
  ASSERT_EQ(blocks.size(), 1U);
  auto control = coarse();
  const auto edges = meshes::build_solid_shaft(shaft, {key}, control).sharp_edges;
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_DOUBLE_EQ(edges[0].distance_m, blocks[0].distance_m);
  EXPECT_DOUBLE_EQ(edges[0].distance_m, 0.003);
  // Chords of 16 cells around would run 0.3 mm inside the circle; 2 um are the parabolas'.
  for (const auto& [from, to] : edges[0].pieces)
    EXPECT_NEAR(std::hypot(from[0] + to[0], from[1] + to[1]) / 2, 0.015, 1e-5);
  double volume = 0, first = 0, second = 0;  // of the discs, about z = 0
  for (const auto& s : shaft.segments) {
    const double r = s.diameter_m / 2, length = s.end_m - s.begin_m, z = (s.begin_m + s.end_m) / 2,
                 its_volume = pi * r * r * length;
    volume += its_volume;
    first += its_volume * z;
    second += its_volume * (r * r / 2 + length * length / 12 + z * z);
  }
  const double size_m = std::sqrt(12 * (second - first * first / volume) / volume);
  EXPECT_NEAR(edges[1].distance_m, 0.01 * size_m, 1e-5);  // the key and the fillets
  control.exclusion_m = 0.001;
  for (const auto& edge : meshes::build_solid_shaft(shaft, {key}, control).sharp_edges)
    EXPECT_EQ(edge.distance_m, 0.001) << edge.name;
}

TEST(SolidShaft, AnOpenKeywayRunsOutAtTheEnd) {
  const auto shaft = plain_cylinder();  // 50 mm, 200 mm long
  const Keyway key{shaft.segments[0].name, 0.014, 0.0055, 0.05, shaft.segments[0].begin_m, 1, false};
  const auto body = meshes::build_solid_shaft(shaft, {key}, coarse());
  EXPECT_NEAR(read_tetrahedra(body).volume_m3 / (true_volume(shaft) - slot_volume(0.025, key)), 1,
              1.2 * lost_by_parabolas(n_around));
}

TEST(SolidShaft, IsBitIdenticalWhenRepeated) {
  const std::vector<Keyway> keys = {{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, true}};
  const auto first = msh_bytes(meshes::build_solid_shaft(keyed_shaft(), keys, coarse()));
  msh_bytes(meshes::build_solid_shaft(three_steps(), {}, coarse()));
  EXPECT_GT(first.size(), 100000u);
  EXPECT_TRUE(msh_bytes(meshes::build_solid_shaft(keyed_shaft(), keys, coarse())) == first);
}

TEST(SolidShaft, KeywaysThatDoNotFitAreRefused) {
  const auto refused = [](const std::function<void(Keyway&)>& change) {
    Keyway key{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, true};
    change(key);
    return refusal_of([&] { meshes::build_solid_shaft(keyed_shaft(), {key}, {}); });
  };
  expect_words(refused([](auto& k) { k.segment = "hub"; }), {"hub", "pulley, body, bearing"});
  expect_words(refused([](auto& k) { k.width_m = 0.025; }), {"width 25 mm", "60 %", "40 mm"});
  expect_words(refused([](auto& k) { k.width_m = -1; }), {"width -1000 mm", "positive"});
  expect_words(refused([](auto& k) { k.depth_m = 0.0005; }), {"depth 0.5 mm", "deeper"});
  expect_words(refused([](auto& k) { k.depth_m = 0.017; }), {"depth 17 mm", "leaves 3 mm", "shallower"});
  expect_words(refused([](auto& k) { k.length_m = 0.05; }), {"60 mm", "to 57 mm", "shorter"});
  expect_words(refused([](auto& k) { k.begin_m = 0; }), {"inside its segment"});
  expect_words(refused([](auto& k) { k.length_m = 0.011; }), {"round ends", "12 mm"});
  const Keyway one{"pulley", 0.012, 0.005, 0.03, 0.01, 0.3, true};
  auto other = one;
  other.angle_rad = 0.8;
  expect_words(refusal_of([&] {
                 meshes::build_solid_shaft(keyed_shaft(), {one, other}, {});
               }),
               {"two keyways on pulley meet"});
  auto stepped = keyed_shaft(0.01);
  stepped.segments[1].bore_m = 0.012;
  stepped.fillets_m[0] = 0;  // a bore may step beside a sharp shoulder only
  expect_words(refusal_of([&] { meshes::build_solid_shaft(stepped, {}, {}); }),
               {"bore of body", "one diameter"});
}

}  // namespace
