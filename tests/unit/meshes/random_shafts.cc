#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "tests/unit/meshes/example_shafts.h"
#include "tests/unit/meshes/mesh_file.h"
#include "tests/unit/meshes/shaft_volume.h"

namespace {

double between(std::mt19937& random, double low, double high) {
  // Not std::uniform_real_distribution: its numbers differ between libraries, and the seed is to fix the
  // shafts.
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

/// 1 to 7 segments of 20 to 100 mm, each 0.35 to 3 diameters long; fillets 5 to 90 % of the step (one in five
/// sharp), at most 15 % of the length that carries them; half of all segments are ports; a segment thicker
/// than both neighbours is eccentric in two of three cases, by 10 to 75 % of the ring left by its fillets.
meshes::Shaft random_shaft(std::mt19937& random) {
  const int n = 1 + static_cast<int>(between(random, 0, 7));
  meshes::Shaft shaft;
  double z_m = between(random, -0.5, 0.5);
  for (int i = 0; i < n; ++i) {
    const double diameter_m = between(random, 0.02, 0.1);
    const double length_m = diameter_m * between(random, 0.35, 3);
    shaft.segments.push_back(
        {"s" + std::to_string(i), z_m, z_m + length_m, diameter_m, 0, between(random, 0, 1) < 0.5});
    z_m += length_m;
  }
  for (int i = 0; i + 1 < n; ++i) {
    const auto &a = shaft.segments[i], &b = shaft.segments[i + 1];
    const auto& small = a.diameter_m < b.diameter_m ? a : b;
    const double step_m = 0.5 * std::abs(a.diameter_m - b.diameter_m);
    const double fillet_m =
        std::min(step_m * between(random, 0.05, 0.9), 0.15 * (small.end_m - small.begin_m));
    shaft.fillets_m.push_back(between(random, 0, 1) < 0.2 ? 0 : fillet_m);
  }
  for (int i = 1; i + 1 < n; ++i) {
    auto& segment = shaft.segments[i];
    const double left_m = 0.5 * shaft.segments[i - 1].diameter_m + shaft.fillets_m[i - 1];
    const double right_m = 0.5 * shaft.segments[i + 1].diameter_m + shaft.fillets_m[i];
    const double ring_m = 0.5 * segment.diameter_m - std::max(left_m, right_m);
    const bool thickest = segment.diameter_m > shaft.segments[i - 1].diameter_m &&
                          segment.diameter_m > shaft.segments[i + 1].diameter_m;
    if (thickest && between(random, 0, 3) < 2) segment.eccentricity_m = ring_m * between(random, 0.1, 0.75);
  }
  return shaft;
}

std::string text(const meshes::Shaft& shaft) {
  std::ostringstream text;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const auto& s = shaft.segments[i];
    text << s.name << " d " << s.diameter_m << " l " << s.end_m - s.begin_m << " e " << s.eccentricity_m;
    if (i < shaft.fillets_m.size()) text << " f " << shaft.fillets_m[i] << "; ";
  }
  return text.str();
}

TEST(RandomShafts, all_mesh_with_good_cells_and_the_right_volume) {
  std::mt19937 random(20240611);
  double worst = 1;
  int n_eccentric = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto shaft = random_shaft(random);
    SCOPED_TRACE(text(shaft));
    for (const auto& segment : shaft.segments) n_eccentric += segment.eccentricity_m != 0;
    meshes::ShaftMeshControl control;
    control.min_scaled_jacobian = 0.01;  // refuse nothing: the test judges
    const int cells_choices[] = {2, 4, 8};
    control.cells_per_fillet_quarter = cells_choices[trial % 3];
    const auto body = meshes::build_shaft(shaft, control, temporary_msh("random"));
    EXPECT_GT(body.quality.min_scaled_jacobian, 0.3);
    worst = std::min(worst, body.quality.min_scaled_jacobian);
    const double expected = polygonal_volume(shaft, control.cells_per_fillet_quarter, control.n_sectors);
    // Rounding of the sum over some 1e4 cells, and of the file's 16 digits against the thinnest cell.
    EXPECT_NEAR(volume_and_moments(read_mesh_file(body.file))[0], expected, 1e-11 * expected);
  }
  RecordProperty("worst_scaled_jacobian", std::to_string(worst));
  EXPECT_GE(n_eccentric, 20);  // else the sample says little about them
}

}  // namespace
