// Shafts whose blocks are laid out coarsely and cut up: all cells shrink alike, and the body stays the same.
#include <gtest/gtest.h>

#include <cmath>

#include "meshes/shaft/half_section.h"
#include "meshes/shaft/shaft.h"
#include "meshes/spacing/disc.h"
#include "meshes/spacing/grading.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/random_bodies.h"
#include "tests/unit/meshes/examples/shaft_volume.h"
#include "tests/unit/meshes/examples/watertight_body.h"

namespace {

meshes::ShaftMeshControl cut_into(int n, int cells = 2, int sectors = 4) {
  meshes::ShaftMeshControl control;
  control.subdivisions = n;
  control.cells_per_fillet_quarter = n * cells;
  control.n_sectors = n * sectors;
  control.growth = 1.0 / n;
  return control;
}

std::vector<meshes::Shaft> shafts() {
  auto result = stepped_bores();
  for (const auto& shaft : {laboratory_shaft(), plain_cylinder(), three_steps(), sharp_eccentric_shaft(),
                            shoulder_shaft(1.1, 0.05), shoulder_shaft(2, 0.2), planetary_drum(),
                            working_shaft(), stub_axle(), two_eccentrics(), grooved_shaft()})
    result.push_back(shaft);
  return result;
}

// Of what lies away from the arcs, with as many cells on them and around.
TEST(LeanShafts, HaveFewerCellsAndTheSameSurfaces) {
  for (const auto& shaft : {laboratory_shaft(), planetary_drum(), grooved_shaft()}) {
    meshes::ShaftMeshControl control;
    control.cells_per_fillet_quarter = 4;
    control.n_sectors = 8;
    const auto usual = meshes::build_shaft(shaft, control);
    control.lean = true;
    const auto lean = meshes::build_shaft(shaft, control);
    EXPECT_LT(double(lean.quality.n_cells), 0.95 * double(usual.quality.n_cells));
    EXPECT_EQ(lean.ports.size(), usual.ports.size());
    EXPECT_EQ(lean.features.size(), usual.features.size());
  }
}

TEST(Subdivision, KeepsValuesAndTheirOrder) {
  const std::vector<double> values{1, 1.1, 2, 2.05, 7};
  for (const int n : {1, 2, 3, 6}) {
    const auto fine = meshes::subdivided(values, n);
    ASSERT_EQ(fine.size(), 4 * std::size_t(n) + 1);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(fine[i * std::size_t(n)], values[i]);
    for (std::size_t i = 1; i < fine.size(); ++i) EXPECT_GT(fine[i], fine[i - 1]) << n << ' ' << i;
  }
  const std::vector<double> falling{3, 1, 0.5};
  const auto fine = meshes::subdivided(falling, 4);
  for (std::size_t i = 1; i < fine.size(); ++i) EXPECT_LT(fine[i], fine[i - 1]);
}

TEST(Subdivision, OfEqualCellsGivesEqualCells) {
  const auto fine = meshes::subdivided({0, 1, 2, 3}, 5);
  for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(fine[i], 0.2 * double(i), 1e-15);
}

// A progression of ratio 2 cut into 4 has the ratio 2^(1/4) = 1.19; the splines are within 3 % of that.
TEST(Subdivision, OfAProgressionIsNearlyOne) {
  const auto fine = meshes::subdivided({0, 1, 3, 7, 15}, 4);
  for (std::size_t i = 2; i < fine.size(); ++i)
    EXPECT_NEAR((fine[i] - fine[i - 1]) / (fine[i - 1] - fine[i - 2]), std::pow(2, 0.25), 0.035) << i;
}

// Cuts into 2 are among those into 4, and of sizes that halve everywhere.
TEST(Subdivision, OfStationsIsNested) {
  meshes::AxialSize size;
  size.sources = {{0, 0.05}};
  size.growth = 0.5;
  size.largest_m = 0.3;
  const auto two = meshes::axial_stations(0, 1, size, 1, 2), four = meshes::axial_stations(0, 1, size, 1, 4);
  ASSERT_EQ(four.size(), 2 * two.size() - 1);
  for (std::size_t i = 0; i < two.size(); ++i) EXPECT_NEAR(two[i], four[2 * i], 1e-12);
}

TEST(SubdividedShafts, HaveAsManyCellsAsTheirLevelSays) {
  for (const auto& shaft : shafts()) {
    SCOPED_TRACE(text(shaft));
    const auto n_cells = [&](int n) { return meshes::build_shaft(shaft, cut_into(n)).quality.n_cells; };
    const std::size_t two = n_cells(2);
    EXPECT_EQ(two % 8, 0u);
    EXPECT_EQ(n_cells(3), two / 8 * 27);
    EXPECT_EQ(n_cells(4), two * 8);
    const auto n_quads = [&](int n) { return meshes::build_half_section(shaft, cut_into(n)).quads.size(); };
    EXPECT_EQ(n_quads(4), 4 * n_quads(2));
    EXPECT_EQ(4 * n_quads(3), 9 * n_quads(2));
  }
}

// Each face of the drawing and each part of the body for itself, so that none shrinks faster than another.
TEST(SubdividedShafts, ShrinkAlikeOnEveryFaceAndInEveryPart) {
  for (const auto& shaft : shafts()) {
    SCOPED_TRACE(text(shaft));
    const auto counts = [&](int n) {
      const auto mesh = read_mesh_file(meshes::build_shaft(shaft, cut_into(n, 4)));
      std::map<std::string, int> result;
      for (const auto& quad : mesh.quads) ++result[mesh.boundary_names.at(quad.group)];
      for (const auto& hex : mesh.hexes) ++result["volume " + mesh.volume_names.at(hex.group)];
      return result;
    };
    const auto two = counts(2), four = counts(4);
    ASSERT_EQ(two.size(), four.size());
    for (const auto& [name, n] : two)
      EXPECT_EQ(four.at(name), n * (name.rfind("volume ", 0) == 0 ? 8 : 4)) << name;
  }
}

TEST(SubdividedShafts, AreWatertightAndHaveTheRightVolume) {
  for (const auto& shaft : shafts())
    for (const auto& [n, cells, sectors] : {std::array{2, 2, 4}, {3, 2, 4}, {4, 2, 8}, {2, 4, 12}}) {
      SCOPED_TRACE(text(shaft));
      const auto body = meshes::build_shaft(shaft, cut_into(n, cells, sectors));
      expect_watertight(body);
      EXPECT_GT(body.quality.min_scaled_jacobian, 0.3);
      const double expected = polygonal_volume(shaft, n * cells, n * sectors);
      EXPECT_NEAR(volume_and_moments(read_mesh_file(body))[0], expected, 1e-11 * expected);  // rounding
    }
}

TEST(SubdividedShafts, MeshWellWhateverTheShaft) {
  std::mt19937 random(20261122);
  for (int trial = 0; trial < n_random_bodies(); ++trial) {
    const auto shaft = trial % 3 == 2 ? random_drum(random) : random_shaft(random);
    SCOPED_TRACE(std::to_string(trial) + ": " + text(shaft));
    auto control = cut_into(2 + trial % 3, trial % 4 == 3 ? 4 : 2, trial % 5 == 3 ? 8 : 4);
    control.min_scaled_jacobian = 0.01;  // refuse nothing: the test judges
    const auto body = meshes::build_shaft(shaft, control);
    EXPECT_GT(body.quality.min_scaled_jacobian, 0.3);
  }
}

}  // namespace
