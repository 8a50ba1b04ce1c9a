// What a control asks for is told before it is meshed, and refused where no memory holds it.
#include <gmsh.h>
#include <gtest/gtest.h>

#include "meshes/chamber/chamber.h"
#include "meshes/checks/affordable.h"
#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/imported.h"
#include "meshes/shaft/shaft.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/solids/model_mesh.h"
#include "meshes/values/refused.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

namespace occ = gmsh::model::occ;

void bored_block() {
  gmsh::vectorpair parts;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, occ::addBox(0, 0, 0, 40, 40, 20)}}, {{3, occ::addCylinder(20, 20, -1, 0, 0, 22, 4)}}, parts,
           map);
  occ::synchronize();
}

void perforated_plate() {
  gmsh::vectorpair holes, parts;
  std::vector<gmsh::vectorpair> map;
  for (int row = 0; row < 2; ++row)
    for (int k = 0; k < 2; ++k)
      holes.push_back({3, occ::addCylinder(10 + 20 * row, 10 + 20 * k, -1, 0, 0, 6, 1.5)});
  occ::cut({{3, occ::addBox(0, 0, 0, 40, 40, 4)}}, holes, parts, map);
  occ::synchronize();
}

void bar_with_small_fillets() {
  const int bar = occ::addBox(0, 0, 0, 20, 20, 50);
  occ::synchronize();
  gmsh::vectorpair parts;
  occ::fillet({bar}, {1, 3}, {1}, parts);
  occ::synchronize();
}

/// Cells of a mesh over those estimated.
double share_of_estimate(const meshes::SolidControl& control, void (*draw)()) {
  double estimate = 0, found = 0;
  meshes::with_gmsh("a sample", [&] {
    draw();
    estimate = meshes::estimated_cells(control, 1e-3);
    found = double(meshes::mesh_and_collect(control, 1e-3).mesh.n_cells());
  });
  return found / estimate;
}

TEST(CellEstimates, CellsAreEstimatedWithinAFactorOfThree) {
  for (const double size_m : {0.01, 0.004})
    for (const int around : {8, 24}) {
      meshes::SolidControl control;
      control.size_m = size_m;
      control.cells_per_circle = around;
      const double share = share_of_estimate(control, bored_block);
      EXPECT_GT(share, 1.0 / 3) << size_m << ' ' << around;
      EXPECT_LT(share, 3) << size_m << ' ' << around;
    }
}

// Between small holes, or small fillets, cells were as small as at their edges: 7 to 10 times those
// estimated.
TEST(CellEstimates, CellsGrowBetweenSmallFeatures) {
  for (const auto draw : {perforated_plate, bar_with_small_fillets}) {
    const double share = share_of_estimate({}, draw);
    EXPECT_GT(share, 1.0 / 3);
    EXPECT_LT(share, 2);
  }
}

TEST(CellEstimates, AbsurdSizesOfStepAreRefusedBeforeMeshing) {
  const auto file = temporary_msh("x").parent_path() / "block.step";
  meshes::with_gmsh("a sample", [&] {
    bored_block();
    gmsh::write(file.string());
  });
  meshes::Import import;
  import.geometry = file;
  import.control.size_m = 1e-9;
  try {
    meshes::build_imported(import);
    ADD_FAILURE() << "meshed";
  } catch (const meshes::TooManyCells& error) {
    EXPECT_EQ(error.control(), "size_m");
    expect_words(error.what(), {"block.step", "cells", "GB of memory", "this machine has", "larger"});
  }
}

TEST(CellEstimates, CellsOfShaftsAreEstimated) {
  for (const auto& shaft : {laboratory_shaft(), plain_cylinder(), planetary_drum(), grooved_shaft()})
    for (const int cells : {2, 8, 16}) {
      meshes::ShaftMeshControl control;
      control.cells_per_fillet_quarter = cells;
      control.min_scaled_jacobian = 0.01;
      const auto body = meshes::build_shaft(shaft, control);
      EXPECT_NEAR(meshes::estimated_cells(shaft, control) / double(body.quality.n_cells), 1,
                  0.2)  // rounded up to whole cells, column by column
          << shaft.segments.front().name << ' ' << cells;
    }
}

TEST(CellEstimates, AbsurdCellsOfBlocksAreRefusedBeforeMeshing) {
  const auto refused_control = [](const auto& build) {
    try {
      build();
    } catch (const meshes::TooManyCells& error) {
      return error.control();
    }
    return std::string("none");
  };
  meshes::ShaftMeshControl control;
  control.largest_cell_m = 1e-9;
  EXPECT_EQ(refused_control([&] { meshes::build_shaft(laboratory_shaft(), control); }), "largest_cell_m");
  control = {};
  control.cells_per_fillet_quarter = 20'000;
  EXPECT_EQ(refused_control([&] { meshes::build_shaft(laboratory_shaft(), control); }),
            "cells_per_fillet_quarter");
  meshes::ChamberMeshControl of_chamber;
  of_chamber.size_m = 1e-9;
  EXPECT_EQ(refused_control([&] { meshes::build_chamber(laboratory_chamber(), of_chamber); }), "size_m");
}

}  // namespace
