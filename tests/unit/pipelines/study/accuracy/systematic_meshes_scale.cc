// Every count and size of a systematic mesh is in proportion to its level.
#include <gtest/gtest.h>

#include "pipelines/study/accuracy/systematic_meshes.h"
#include "tests/unit/pipelines/examples/laboratory.h"

namespace {

pipelines::BodyScene shaft(int cells, int sectors) {
  auto body = laboratory::scene().bodies.front();
  auto& mesh = std::get<pipelines::ShaftShape>(body.shape).mesh;
  mesh.cells_per_fillet_quarter = cells;
  mesh.n_sectors = sectors;
  mesh.fillet_cells = {0, 16};
  mesh.largest_cell_m = 0.012;
  return body;
}

}  // namespace

TEST(SystematicMeshes, ShaftsScaleAllCounts) {
  for (const auto& [cells, sectors] : {std::pair{8, 16}, {6, 24}, {16, 64}, {2, 8}}) {
    const auto body = shaft(cells, sectors);
    const auto coarsest = pipelines::systematic_mesh(body, 2).shaft()->mesh;
    for (const int level : pipelines::systematic_levels) {
      const auto mesh = pipelines::systematic_mesh(body, level).shaft()->mesh;
      EXPECT_EQ(2 * mesh.cells_per_fillet_quarter, level * coarsest.cells_per_fillet_quarter);
      EXPECT_EQ(2 * mesh.n_sectors, level * coarsest.n_sectors);
      EXPECT_EQ(mesh.subdivisions, level) << "one layout, cut into ever more cells";
      EXPECT_EQ(mesh.fillet_cells, (std::vector<int>{0, 4 * level}));
      EXPECT_EQ(mesh.cells_per_fillet_quarter % 2, 0);
      EXPECT_EQ(mesh.n_sectors % 8, 0);
      EXPECT_NEAR(mesh.growth * level, 2 * coarsest.growth, 1e-12);  // rounding, also below
      EXPECT_LE(mesh.growth, 1);
      EXPECT_NEAR(mesh.largest_cell_m * level, 0.012 * 4, 1e-12);
    }
  }
  // Level 4 of the shipped shaft has its own cells on the fillets.
  EXPECT_EQ(pipelines::systematic_mesh(shaft(8, 16), 4).shaft()->mesh.cells_per_fillet_quarter, 8);
}

TEST(SystematicMeshes, ChambersScaleAllSizes) {
  pipelines::BodyScene body;
  pipelines::ChamberShape shape;
  shape.geometry.tube.inner_radius_m = 0.13;
  shape.geometry.tube.wall_m = 0.006;
  shape.mesh.size_m = 0.02;
  for (const int through : {1, 2, 4}) {
    shape.mesh.cells_through_wall = through;
    body.shape = shape;
    const auto control = [&](int level) {
      return std::get<pipelines::ChamberShape>(pipelines::systematic_mesh(body, level).shape).mesh;
    };
    const auto coarsest = control(2);
    EXPECT_EQ(coarsest.cells_through_wall, through == 4 ? 4 : 2);
    for (const int level : pipelines::systematic_levels) {
      const auto mesh = control(level);
      EXPECT_EQ(2 * mesh.cells_through_wall, level * coarsest.cells_through_wall);
      EXPECT_NEAR(mesh.size_m * level, 2 * coarsest.size_m, 1e-12);  // rounding
      EXPECT_NEAR(mesh.toe_walls * level, 2 * coarsest.toe_walls, 1e-12);
      EXPECT_NEAR(mesh.growth * level, 2 * coarsest.growth, 1e-12);
    }
  }
}

TEST(SystematicMeshes, CellSizeIsThatOfACube) {
  fem::Nodes nodes;
  nodes.degree = 1;
  nodes.cells.assign(5 * 8, 0);
  nodes.volume_m3 = {0.01, 0.03};
  EXPECT_NEAR(pipelines::cell_size_m(nodes), 0.2, 1e-15);  // 0.04 over 5 cells
  nodes.cells.clear();
  EXPECT_THROW(pipelines::cell_size_m(nodes), std::invalid_argument);
}
