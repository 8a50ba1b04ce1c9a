#include <gtest/gtest.h>

#include "pipelines/refinement.h"
#include "pipelines/scene.h"

using namespace pipelines;

namespace {

const meshes::ChamberMeshControl& mesh_of(const BodyScene& body) {
  return std::get<ChamberShape>(body.shape).mesh;
}

}  // namespace

// Each step has one more cell through the walls; cells at the weld toes shrink most, all others a little; and
// what the next mesh is does not depend on a tolerance.
TEST(Refine, AChamberWhereItsHotSpotsFeelIt) {
  Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
  const std::size_t chamber = 1;
  ASSERT_EQ(scene.bodies[chamber].role, BodyRole::chamber);
  scene.bodies[chamber] = coarsest(scene.bodies[chamber]);
  BodyAnalysis analysis;
  analysis.hot_spots.emplace_back();
  analysis.hot_spots.front().von_mises_Pa = 40e6;
  analysis.hot_spot_errors.set_numerical({"discretisation", "", 4e6});
  for (int step = 0; step < 4; ++step) {
    const auto before = mesh_of(scene.bodies[chamber]);
    const auto refinement = refine(scene, chamber, analysis, false);
    const auto& after = mesh_of(scene.bodies[chamber]);
    EXPECT_TRUE(refinement.possible && refinement.new_mesh);
    EXPECT_EQ(after.cells_through_wall, before.cells_through_wall + 1);
    EXPECT_DOUBLE_EQ(refinement.ratio, double(after.cells_through_wall) / before.cells_through_wall);
    EXPECT_LT(after.toe_walls, before.toe_walls / 1.5);
    EXPECT_LT(after.size_m, before.size_m);
    EXPECT_GT(after.size_m, before.size_m / 1.5);
    EXPECT_LT(after.growth, before.growth);
  }
}
