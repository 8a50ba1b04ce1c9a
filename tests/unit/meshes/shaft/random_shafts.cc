#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/random_bodies.h"
#include "tests/unit/meshes/examples/shaft_volume.h"

namespace {

/// Smallest scaled Jacobian of all, once each has been judged.
double worst_of(const std::function<meshes::Shaft()>& draw) {
  double worst = 1;
  std::size_t most_cells = 0;
  const int n = n_random_bodies();
  for (int trial = 0; trial < n; ++trial) {
    const auto shaft = draw();
    SCOPED_TRACE(std::to_string(trial) + ": " + text(shaft));
    meshes::ShaftMeshControl control;
    control.min_scaled_jacobian = 0.01;  // refuse nothing: the test judges
    const int cells_choices[] = {2, 4, 8}, sector_choices[] = {16, 8, 24, 16, 12};
    control.cells_per_fillet_quarter = cells_choices[trial % 3];
    control.n_sectors = sector_choices[trial % 5];
    control.rows_factor = std::array{1.0, 1.5, 1.0, 3.375}[std::size_t(trial % 4)];
    control.lean = trial % 7 < 3;
    meshes::BodyMesh body;
    EXPECT_NO_THROW(body = meshes::build_shaft(shaft, control));
    if (!body.cells) continue;
    EXPECT_GT(body.quality.min_scaled_jacobian, 0.3)
        << "at z = " << body.quality.worst_z_m
        << ", r = " << std::hypot(body.quality.worst_x_m, body.quality.worst_y_m) << ", cells "
        << control.cells_per_fillet_quarter << ", sectors " << control.n_sectors << ", rows times "
        << control.rows_factor << (control.lean ? ", lean" : "");
    worst = std::min(worst, body.quality.min_scaled_jacobian);
    most_cells = std::max(most_cells, body.quality.n_cells);
    const double expected = polygonal_volume(shaft, control.cells_per_fillet_quarter, control.n_sectors);
    // Rounding of the sum over some 1e4 cells, and of the file's 16 digits against the thinnest cell.
    EXPECT_NEAR(volume_and_moments(read_mesh_file(body))[0], expected, 1e-11 * expected);
  }
  testing::Test::RecordProperty("most_cells", std::to_string(most_cells));
  return worst;
}

TEST(RandomShafts, AllMeshWithGoodCellsAndTheRightVolume) {
  std::mt19937 random(20240611);
  int n_eccentric = 0, n_bored = 0, n_steps = 0, n_grooves = 0;
  const double worst = worst_of([&] {
    auto shaft = random_shaft(random);
    bool bored = false;
    for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
      const auto& segment = shaft.segments[i];
      n_eccentric += segment.eccentricity_m != 0;
      n_grooves += segment.name.rfind("groove", 0) == 0;
      n_steps += i > 0 && segment.bore_m != shaft.segments[i - 1].bore_m;
      bored = bored || segment.bore_m > 0;
    }
    n_bored += bored;
    return shaft;
  });
  RecordProperty("worst_scaled_jacobian", std::to_string(worst));
  // Else the sample says little about them.
  EXPECT_GE(n_eccentric, 20);
  EXPECT_GE(n_bored, 10);
  EXPECT_GE(n_steps, 6);
  EXPECT_GE(n_grooves, 20);
}

/// Rows through a wall multiply, and nothing else does: a tube has sectors x rows x stations cells.
TEST(RowsThroughAWall, AreAsManyTimesMoreAsIsAsked) {
  meshes::Shaft tube;
  tube.segments = {{"tube", 0, 0.2, 0.05, 0, true}};
  tube.segments[0].bore_m = 0.02;
  const auto cells = [&](double rows_factor) {
    meshes::ShaftMeshControl control;
    control.rows_factor = rows_factor;
    return meshes::build_shaft(tube, control).quality.n_cells;
  };
  EXPECT_EQ(cells(1.5), cells(1) / 2 * 3);
  EXPECT_EQ(cells(2), 2 * cells(1));
}

TEST(RandomDrums, AllMeshWithGoodCellsAndTheRightVolume) {
  std::mt19937 random(20250301);
  const double worst = worst_of([&] { return random_drum(random); });
  RecordProperty("worst_scaled_jacobian", std::to_string(worst));
}

}  // namespace
