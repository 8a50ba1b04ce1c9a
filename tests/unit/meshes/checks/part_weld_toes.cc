/// Where hot-spot stress is read beside sharp inner edges that a scene calls welds.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/meshes/examples/imports.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

namespace occ = gmsh::model::occ;

constexpr double t_m = 0.012;

/// A base plate of 100 x 12 x 40 mm and an upright of 12 mm on its middle, the base's top at y = 12 mm.
meshes::Import tee(const std::vector<meshes::PartWeld>& welds) {
  static const auto file = written("tee.step", [] {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, occ::addBox(-50, 0, 0, 100, 12, 40)}}, {{3, occ::addBox(-6, 12, 0, 12, 50, 40)}}, result,
              map);
    occ::synchronize();
  });
  auto import = import_of(file, {});
  import.welds = welds;
  return import;
}

const meshes::PartWeld on_the_right{{0.006, t_m, 0.02}, t_m};

}  // namespace

// Toes on the base and on the upright, each with its points on the same face, straight away from the edge.
// Turns red: points across the plate, the other edge's toes, distances of other thicknesses.
TEST(PartWelds, AreReadOnBothFacesAcrossTheEdge) {
  const auto body = meshes::build_imported(tee({on_the_right}));
  int n_on_base = 0, n_on_upright = 0;
  for (const auto& spot : body.hot_spots) {
    EXPECT_EQ(spot.thickness_m, t_m);
    EXPECT_NEAR(spot.toe_m[0], 0.006, 1e-9) << spot.name;
    EXPECT_NEAR(spot.toe_m[1], t_m, 1e-9) << spot.name;
    const bool is_on_base = std::abs(spot.near_m[1] - t_m) < 1e-9;
    (is_on_base ? n_on_base : n_on_upright) += 1;
    const int across = is_on_base ? 0 : 1, other = 1 - across;
    EXPECT_NEAR(spot.near_m[across] - spot.toe_m[across], 0.4 * t_m, 1e-9) << spot.name;
    EXPECT_NEAR(spot.far_m[across] - spot.toe_m[across], 1.0 * t_m, 1e-9) << spot.name;
    for (const auto& point : {spot.near_m, spot.far_m}) {
      EXPECT_NEAR(point[other], spot.toe_m[other], 1e-9) << spot.name;
      EXPECT_NEAR(point[2], spot.toe_m[2], 1e-9) << spot.name;
    }
  }
  // One every thickness along 40 mm, and none twice.
  EXPECT_EQ(n_on_base, 4);
  EXPECT_EQ(n_on_base, n_on_upright);
  EXPECT_TRUE(body.covered_toes.empty());
  // The same on another mesh.
  auto finer = tee({on_the_right});
  finer.control.size_factor = 0.6;
  const auto again = meshes::build_imported(finer);
  ASSERT_EQ(again.hot_spots.size(), body.hot_spots.size());
  for (std::size_t i = 0; i < body.hot_spots.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_EQ(again.hot_spots[i].name, body.hot_spots[i].name);
      EXPECT_NEAR(again.hot_spots[i].far_m[d], body.hot_spots[i].far_m[d], 1e-9);
    }
  std::vector<std::string> names;
  for (const auto& spot : body.hot_spots) names.push_back(spot.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

// What lies within a plate thickness of the weld is its hot spot's, not the peak's; the other edge stays as
// it is.
TEST(PartWelds, KeepAThicknessOutOfThePeak) {
  const auto plain = meshes::build_imported(tee({})), welded = meshes::build_imported(tee({on_the_right}));
  ASSERT_EQ(welded.sharp_edges.size(), 2U);
  ASSERT_EQ(plain.sharp_edges.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const bool is_weld = welded.sharp_edges[i].pieces.front()[0][0] > 0;
    EXPECT_EQ(welded.sharp_edges[i].distance_m, is_weld ? t_m : plain.sharp_edges[i].distance_m);
  }
}

// Where the base ends nearer than a thickness, its toes are not read, and are told.
TEST(PartWelds, FacesThatEndBeforeAreTold) {
  const auto body = meshes::build_imported(tee({{{0.006, t_m, 0.02}, 0.045}}));
  EXPECT_FALSE(body.covered_toes.empty());
  for (const auto& spot : body.hot_spots)
    EXPECT_NEAR(spot.far_m[1] - t_m, 0.045, 1e-9) << "the upright is long enough";
}

TEST(PartWelds, ThatAreNoneAreRefused) {
  const auto refusal = refusal_of([] { meshes::build_imported(tee({{{0.03, t_m, 0.02}, t_m}})); });
  expect_words(refusal, {"the weld at (30, 12, 20) mm", "no sharp inner edge"});
}
