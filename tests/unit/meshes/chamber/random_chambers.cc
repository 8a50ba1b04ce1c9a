/// Chambers drawn at random from the documented ranges: meshed well, or refused with a reason.
/// MILLSTRESS_CHAMBERS says how many are to be meshed (default 50); the same seed every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "meshes/chamber/chamber.h"
#include "tests/unit/meshes/examples/chamber_solids.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

int n_chambers() {
  const char* text = std::getenv("MILLSTRESS_CHAMBERS");
  return text ? std::atoi(text) : 50;
}

TEST(RandomChambers, AllMeshWithGoodCellsAndTheRightVolume) {
  std::mt19937 random(20250611);
  meshes::ChamberMeshControl control;
  control.min_scaled_jacobian = 0.01;  // refuse nothing: the test judges
  double worst = 1, largest_aspect = 0;
  std::size_t most_cells = 0, n_hot_spots = 0;
  int n_refused = 0;
  for (int n_meshed = 0; n_meshed < n_chambers();) {
    const auto chamber = random_chamber(random);
    SCOPED_TRACE(text(chamber));
    control.lean = n_meshed % 2 == 1;
    control.toe_walls =
        control.lean ? meshes::ChamberMeshControl::lean_toe_walls : meshes::ChamberMeshControl().toe_walls;
    meshes::BodyMesh body;
    try {
      body = meshes::build_chamber(chamber, control);
    } catch (const std::invalid_argument& refused) {  // parts in each other's way: the draw allows it
      EXPECT_GT(std::string(refused.what()).size(), 40u);
      ASSERT_LT(++n_refused, 20 + 3 * n_chambers()) << refused.what();
      continue;
    }
    ++n_meshed;
    ASSERT_GT(body.quality.min_scaled_jacobian, 0.3);
    worst = std::min(worst, body.quality.min_scaled_jacobian);
    largest_aspect = std::max(largest_aspect, body.quality.max_aspect);
    most_cells = std::max(most_cells, body.quality.n_cells);
    n_hot_spots += body.hot_spots.size();
    const MeshFile mesh = read_mesh_file(body);
    const auto measured = mesh_sums(mesh);
    // Rounding of sums over 1e4 to 1e5 cells, and of 16 digits against the thinnest wall.
    for (const auto& [part, sums] : solid_sums(chamber, angles_of(mesh, chamber)))
      ASSERT_NEAR(measured.at(part)[0], sums[0], 1e-10 * sums[0]) << part;
    std::map<std::string, double> areas;
    for (const auto& quad : mesh.quads) {
      const auto &a = mesh.points[quad.nodes[0]], &b = mesh.points[quad.nodes[1]],
                 &d = mesh.points[quad.nodes[3]];
      if (a[2] == b[2] && a[2] == d[2]) continue;  // faces normal to z are inside the volumes already
      const double along_m = std::max(std::abs(b[2] - a[2]), std::abs(d[2] - a[2]));
      const auto& across = a[2] == b[2] ? b : d;
      areas[mesh.boundary_names.at(quad.group)] += along_m * std::hypot(across[0] - a[0], across[1] - a[1]);
    }
    const auto expected_areas = feature_areas(chamber, angles_of(mesh, chamber));
    for (const std::string name : {"inner_wall", "tube outside", "housing outside", "spring_foot_1"})
      ASSERT_NEAR(areas.at(name), expected_areas.at(name), 1e-10 * expected_areas.at(name)) << name;
  }
  std::printf(
      "%d meshed, %d refused: worst scaled Jacobian %.4f, largest aspect %.0f, most cells %zu, %.1f "
      "hot spots each\n",
      n_chambers(), n_refused, worst, largest_aspect, most_cells,
      static_cast<double>(n_hot_spots) / n_chambers());
}

}  // namespace
