/// A plain round bar in rotating bending, meshed and solved: amplitude and mean at every node of its surface
/// away from the ends against M r / I. Turns red: a walk that stops short of the largest pair, means of pairs
/// that are not opposite, a moment of half the load, loads that turn with the shaft counted as cycles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/life/fatigue_places.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/unit/pipelines/examples/shared_environment.h"

namespace {

using namespace pipelines;

/// Diameter, and length between the middles of the bearings [m]; of the load that its mass gives [m/s2].
constexpr double diameter_m = 0.01, span_m = 0.2, seat_m = 0.004, acceleration_m_s2 = 800,
                 density_kg_m3 = 7850;

/// @param order  of the acceleration in axes that turn with the bar: 1 stands still in space, 0 turns with it
SceneRun bar_of(const std::filesystem::path& directory, int order, const std::string& mesh) {
  const std::string entries =
      order == 0
          ? "[[machine.constants]]\neffect = \"weight\"\nload = \"volume.ax\"\nvalue = \"800 m/s2\"\n"
          : "[[machine.harmonics]]\neffect = \"weight\"\nload = \"volume.ax\"\namplitude = \"800 m/s2\"\n"
            "order = 1\n[[machine.harmonics]]\neffect = \"weight\"\nload = \"volume.ay\"\n"
            "amplitude = \"800 m/s2\"\norder = 1\nphase = \"90 deg\"\n";
  // Without pressure patterns: their even part would not reverse with the force.
  std::ofstream(directory / "scene.toml") << "effects = [\"weight\"]\nmethod = \"solid\"\n[machine]\n"
                                             "type = \"load_table\"\nspeed = \"600 rpm\"\n"
                                          << entries << R"([sampling]
instants_per_turn = 96
turns = 1
[shaft]
contour = [{ port = "left", diameter = "10 mm", length = "4 mm" },
           { name = "bar", diameter = "10 mm", length = "196 mm" },
           { port = "right", diameter = "10 mm", length = "4 mm" }]
bearings = ["left", "right"]
torque_support = "right"
pressure_harmonics = 0
[shaft.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
[shaft.fatigue]
tensile_strength = "600 MPa"
roughness = "1 um"
[results]
snapshots = 0
pictures = false
[shaft.mesh]
)" << mesh;
  shared::start_fem();
  SceneRunOptions options;
  options.n_threads = 1;
  options.cache = false;
  options.second_model = false;
  options.accuracy.once = true;
  StageClock clock;
  return run_scene(read_scene(directory / "scene.toml"), options, clock);
}

/// M r / I at z from the left end, of a bar under its own mass between the middles of its seats.
double closed_form_Pa(double z_m) {
  const double area = M_PI * diameter_m * diameter_m / 4, inertia = area * diameter_m * diameter_m / 16;
  const double load_N_m = density_kg_m3 * acceleration_m_s2 * area, at_m = z_m - seat_m / 2;
  const double overhang_Nm = load_N_m * seat_m * seat_m / 8;
  return (load_N_m * at_m * (span_m - at_m) / 2 - overhang_Nm) * diameter_m / 2 / inertia;
}

bool is_away_from_seats(double z_m, double diameters) {
  return std::min(z_m, span_m + seat_m - z_m) > seat_m + diameters * diameter_m;
}

/// Where what seats do to a section has spread to some 1e-4 (Saint-Venant).
constexpr double from_seats = 2;
/// A seat presses on one side only, so that a part of its pressure does not reverse but pulsates twice a
/// turn. That part has no resultant and dies out along the bar, 13-fold in a diameter: 6e-6 of the
/// peak at three, 1e-9 at six.
constexpr double far_from_seats = 7;

/// By how much a node's amplitude differs from the closed form at most, in rho a r: the theory of beams
/// leaves out stresses of that order, by which the load is handed on across the section.
double off(const Judged& analysis) {
  const auto& cycles = analysis.fatigue->cycles;
  double most = 0;
  int n = 0;
  for (std::size_t i = 0; i < cycles.nodes.size(); ++i) {
    const double* x = &analysis.responses.nodes.xyz_m[3 * cycles.nodes[i]];
    if (!is_away_from_seats(x[2], from_seats)) continue;
    ++n;
    most = std::max(most, std::abs(cycles.cycles[i].amplitude_Pa - closed_form_Pa(x[2])));
  }
  EXPECT_GT(n, 100);
  return most / (density_kg_m3 * acceleration_m_s2 * diameter_m / 2);
}

// Half of rho a r, 16 kPa beside 25 MPa, is allowed for what the closed form leaves out and for the mesh;
// with cells two thirds as large it is not more. The run states more of itself. Mean, and amplitude against
// the peak, are exact on any mesh: 96 instants meet the crest of every node, of sixteen and of 24 round the
// bar.
TEST(RotatingBending, AtEveryNodeOfASolvedBar) {
  const results_test::Directory directory;
  const auto run = bar_of(directory.path, 1, "sectors = 8\nlargest_cell = \"10 mm\"\n");
  const auto& analysis = run.analyses.at(0);
  const double coarse = off(analysis);
  EXPECT_LT(coarse, 0.5);
  EXPECT_LT(coarse * density_kg_m3 * acceleration_m_s2 * diameter_m / 2,
            governing_stress(analysis).errors.numerical_Pa());

  const FatigueRules rules(*analysis.scene.fatigue);
  const SurfaceSlopes slopes(analysis.responses.nodes);
  const auto& most_Pa = analysis.envelope.von_mises.value_Pa;
  const FatiguePlaces places(analysis, slopes, analysis.loads.history, most_Pa, rules);
  const double peak_Pa = governing_stress(analysis).value_Pa;
  const auto& cycles = analysis.fatigue->cycles;
  int n_far = 0;
  for (std::size_t i = 0; i < cycles.nodes.size(); ++i) {
    const auto node = cycles.nodes[i];
    if (!is_away_from_seats(analysis.responses.nodes.xyz_m[3 * node + 2], far_from_seats)) continue;
    ++n_far;
    for (const auto& cycle : {scalar(cycles.cycles[i]), scalar(places.at(node).cycle)}) {
      ASSERT_NEAR(cycle.amplitude_Pa, most_Pa[node], 1e-9 * peak_Pa) << node;
      ASSERT_NEAR(cycle.mean_Pa, 0, 1e-9 * peak_Pa) << node;
    }
  }

  const double fine =
      off(bar_of(directory.path, 1, "sectors = 12\nlargest_cell = \"7 mm\"\n").analyses.at(0));
  std::printf("off by %.3f and %.3f rho a r\n", coarse, fine);
  EXPECT_LE(fine, coarse);
}

TEST(RotatingBending, OfALoadThatTurnsWithTheBarHasNoAmplitude) {
  const results_test::Directory directory;
  const auto run = bar_of(directory.path, 0, "sectors = 8\nlargest_cell = \"20 mm\"\n");
  const auto& analysis = run.analyses.at(0);
  const double peak_Pa = governing_stress(analysis).value_Pa;
  EXPECT_NEAR(peak_Pa, closed_form_Pa((span_m + seat_m) / 2), 0.02 * peak_Pa);
  for (const auto& cycle : analysis.fatigue->cycles.cycles) ASSERT_EQ(cycle.amplitude_Pa, 0);
}

}  // namespace
