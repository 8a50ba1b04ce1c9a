#include <gtest/gtest.h>

#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/refinement/refinement.h"

using namespace pipelines;

namespace {

const meshes::ChamberMeshControl& mesh_of(const BodyScene& body) {
  return std::get<ChamberShape>(body.shape).mesh;
}

/// The weld toes as places, all with an error of that size.
std::vector<PlaceStress> toes_of(const Judged& analysis, double error_Pa) {
  std::vector<PlaceStress> places;
  for (const auto& spot : analysis.hot_spots)
    places.push_back({spot.name, 0, spot.von_mises_Pa, error_Pa, {}});
  return places;
}

}  // namespace

// Each step has one more cell through the walls; cells halve at the weld toes that may have the largest
// stress, shrink a little at the others and elsewhere; and what the next mesh is does not depend on a
// tolerance.
TEST(Refine, AChamberWhereItsHotSpotsFeelIt) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
  const std::size_t chamber = 1;
  ASSERT_TRUE(std::holds_alternative<ChamberOptions>(scene.bodies[chamber].options));
  scene.bodies[chamber] = first_meshes(scene.bodies[chamber]).front();
  Judged analysis;
  analysis.hot_spots.resize(3);
  analysis.hot_spots[0].von_mises_Pa = 40e6;
  analysis.hot_spots[1].von_mises_Pa = 37e6;  // 41 with its error
  analysis.hot_spots[2].von_mises_Pa = 35e6;  // 39
  for (std::size_t i = 0; i < 3; ++i) {
    analysis.hot_spots[i].name = "toe " + std::to_string(i);
    analysis.hot_spots[i].toe_m[2] = 0.01 * double(i);
  }
  double finest = mesh_of(scene.bodies[chamber]).toe_walls;
  for (int step = 0; step < 4; ++step) {
    const auto before = mesh_of(scene.bodies[chamber]);
    const auto made = refine_mesh(scene.bodies[chamber], analysis, toes_of(analysis, 4e6), MeshPart::all);
    const auto& after = mesh_of(scene.bodies[chamber]);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->ratio, 2);
    EXPECT_EQ(made->order, 1);
    EXPECT_EQ(made->features, (std::vector<std::string>{"toe 0", "toe 1"}));
    EXPECT_EQ(after.cells_through_wall, before.cells_through_wall + 1);
    finest /= 2;
    ASSERT_EQ(after.fine_toes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_DOUBLE_EQ(after.fine_toes[i].walls, finest);
      EXPECT_EQ(after.fine_toes[i].at_m, analysis.hot_spots[i].toe_m);
    }
    for (const auto& [smaller, larger] :
         {std::pair{after.toe_walls, before.toe_walls}, {after.size_m, before.size_m}}) {
      EXPECT_LT(smaller, larger);
      EXPECT_GT(smaller, larger / 1.5);
    }
    EXPECT_LT(after.growth, before.growth);
  }
  // The mesher refuses more: a search that is there goes on with its other cells.
  auto& mesh = std::get<ChamberShape>(scene.bodies[chamber].shape).mesh;
  mesh.cells_through_wall = meshes::ChamberMeshControl::most_cells_through_wall;
  ASSERT_TRUE(refine_mesh(scene.bodies[chamber], analysis, toes_of(analysis, 4e6), MeshPart::all));
  EXPECT_EQ(mesh_of(scene.bodies[chamber]).cells_through_wall,
            meshes::ChamberMeshControl::most_cells_through_wall);
}

// A toe that joins the leading ones later starts from the others' cells; one that no longer leads keeps its
// own.
TEST(Refine, AChambersToesKeepTheirCells) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
  const std::size_t chamber = 1;
  Judged analysis;
  analysis.hot_spots.resize(2);
  analysis.hot_spots[0].von_mises_Pa = 40e6;
  analysis.hot_spots[0].toe_m = {0.1, 0, 0};
  analysis.hot_spots[1].von_mises_Pa = 20e6;
  analysis.hot_spots[1].toe_m = {0.2, 0, 0};
  analysis.hot_spots[0].name = "toe 0";
  analysis.hot_spots[1].name = "toe 1";
  refine_mesh(scene.bodies[chamber], analysis, toes_of(analysis, 1e6), MeshPart::all);
  const double once = mesh_of(scene.bodies[chamber]).fine_toes.at(0).walls;
  const double others = mesh_of(scene.bodies[chamber]).toe_walls;
  std::swap(analysis.hot_spots[0].toe_m, analysis.hot_spots[1].toe_m);
  refine_mesh(scene.bodies[chamber], analysis, toes_of(analysis, 1e6), MeshPart::all);
  const auto& toes = mesh_of(scene.bodies[chamber]).fine_toes;
  ASSERT_EQ(toes.size(), 2U);
  EXPECT_EQ(toes[0].walls, once);
  EXPECT_EQ(toes[1].walls, others / 2);
  EXPECT_EQ(toes[1].at_m, analysis.hot_spots[0].toe_m);
}

// A surface that may hold more than the toes is no matter of the toes' cells: the whole mesh becomes finer.
TEST(Refine, AChamberEverywhereWhereASurfaceHoldsTheErrorBack) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
  BodyScene& chamber = scene.bodies[1];
  Judged analysis;
  analysis.hot_spots.resize(1);
  analysis.hot_spots[0].name = "toe";
  analysis.hot_spots[0].von_mises_Pa = 40e6;
  auto places = toes_of(analysis, 1e6);
  places.push_back({"tube outside", 0, 30e6, 20e6, {}});
  const auto before = mesh_of(chamber);
  const auto made = refine_mesh(chamber, analysis, places, MeshPart::all);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->features.empty());
  EXPECT_NEAR(mesh_of(chamber).toe_walls, before.toe_walls / made->ratio, 1e-12);
  EXPECT_TRUE(mesh_of(chamber).fine_toes.empty());
}
