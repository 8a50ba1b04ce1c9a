/// The chamber's peak outside the exclusion distances from mesh to mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "pipelines/judge/estimates/fineness.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/verification/chambers/chamber_scene.h"

namespace {

/// A stress and its numerical error.
struct Stated {
  double value_Pa = 0, error_Pa = 0;
};

struct Found {
  Stated peak, hot_spot;
};

Found found_at(double fineness) {
  const results_test::Directory directory;
  auto scene = chambers::scene_around(chambers::small_chamber(), directory.path);
  scene.bodies[0] = pipelines::with_fineness(scene.bodies[0], fineness);
  const auto run = chambers::run(scene);
  const auto& a = run.analyses.at(0);
  const Found found{{a.peak.value_Pa, a.peak.errors.numerical_Pa()},
                    {a.hot_spots.at(0).von_mises_Pa, a.hot_spot_errors.numerical_Pa()}};
  std::printf("%.2f: %zu unknowns, peak %.2f +- %.2f MPa at %s, hot spot %.2f +- %.2f MPa at %s\n", fineness,
              a.responses.n_dofs, found.peak.value_Pa / 1e6, found.peak.error_Pa / 1e6,
              a.peak.feature.c_str(), found.hot_spot.value_Pa / 1e6, found.hot_spot.error_Pa / 1e6,
              a.hot_spots.at(0).name.c_str());
  std::fflush(stdout);
  return found;
}

// Peak and hot spot of two coarse meshes lie within their stated errors of 9.76 and 15.85 MPa, which the same
// chamber has with 5 cells through the wall and cells of 0.08 walls at the worst toe (384765 unknowns).
// Before, nodes on the web's edge beside the toe said 11.0 +- 51 and 8.6 +- 56 MPa: an error that says
// nothing is kept away by its size, half of the stress.
TEST(ChamberPeak, IsWithinItsErrorLikeTheHotSpot) {
  constexpr double peak_Pa = 9.76e6, hot_spot_Pa = 15.85e6;
  for (const double fineness : {0.667, 1.0}) {
    const auto found = found_at(fineness);
    EXPECT_NEAR(found.peak.value_Pa, peak_Pa, found.peak.error_Pa) << fineness;
    EXPECT_LT(found.peak.error_Pa, 0.5 * peak_Pa) << fineness;
    EXPECT_NEAR(found.hot_spot.value_Pa, hot_spot_Pa, found.hot_spot.error_Pa) << fineness;
  }
}

}  // namespace
