// What harmonics of a seat's pressure that were left out bring to the peak of a run, against half as
// many again as its estimate looks at.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/unit/pipelines/search/cheap_models/loaded_shaft.h"

namespace {

using namespace pipelines;
using loaded_shaft::LoadedShaft;

/// The loaded seat ends at the fillet.
Scene beside_seat(int n_harmonics) {
  std::string text = loaded_shaft::overhung;
  const std::string seat = "length = \"18 mm\" },",
                    thin = "  { name = \"thin\",    diameter = \"44 mm\", length = \"26 mm\" },\n";
  text.replace(text.find(seat), seat.size(), "length = \"44 mm\" },");
  text.replace(text.find(thin), thin.size(), "");
  auto scene = loaded_shaft::scene_of(text);
  scene.bodies[0].pressure_harmonics = n_harmonics;
  return scene;
}

/// The largest stress on a coarse section, which is 0.2 % off with any number of harmonics alike.
double peak_Pa(Scene scene) {
  LoadedShaft shaft(std::move(scene));
  AxisymmetricRefinement refinement(shaft.body(), shaft.loaded.meshed[0], shaft.loaded.body_loads[0], 1);
  return refinement.next(shaft.clock).peak().value_Pa;
}

TEST(TailOfPressures, IsSolvedWhereItLeads) {
  const auto own = LoadedShaft(beside_seat(4)).axisymmetric(0.005);
  const double stated_Pa = own.peak.errors.of("pressure_harmonics");
  const int solved = own.search.steps.back().pressure_harmonics;
  const double missing_Pa = std::abs(peak_Pa(beside_seat(36)) - peak_Pa(beside_seat(solved)));
  std::printf("%.3f MPa, %s: %d harmonics leave %.4f, stated %.4f of %.4f\n", own.peak.value_Pa / 1e6,
              own.peak.feature.c_str(), solved, missing_Pa / 1e6, stated_Pa / 1e6,
              own.peak.errors.numerical_Pa() / 1e6);
  EXPECT_TRUE(own.search.met);
  EXPECT_GE(stated_Pa, missing_Pa);
  EXPECT_LE(stated_Pa, 4 * missing_Pa) << "an error that holds everything says nothing";
}

}  // namespace
