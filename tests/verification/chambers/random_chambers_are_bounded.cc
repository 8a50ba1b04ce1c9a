/// What a search, which refines locally, states of random chambers beside even meshes with submodels.
/// MILLSTRESS_PROMISED_CHAMBERS says how many (default 10), MILLSTRESS_CHAMBER_SEED which (the same every
/// time without it). Webs of every second one are symmetrical about its middle, and with them the whole
/// chamber.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/search/refinement/refinement.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/verification/chambers/chamber_scene.h"

namespace {

constexpr double asked = 0.05;

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : otherwise;
}

meshes::Chamber symmetrical(meshes::Chamber chamber) {
  auto& z_m = chamber.webs.z_m;
  for (std::size_t i = 0; i < z_m.size() / 2; ++i) z_m[i] = -z_m[z_m.size() - 1 - i];
  return chamber;
}

/// Four times the instants that a search has ended with, and eight harmonics of every pressure more: what the
/// search leaves out of these is part of its error.
void describe_loads_better(pipelines::Scene& scene, const pipelines::Scene& found) {
  constexpr int more_harmonics = 8, times_instants = 4;
  scene.sampling.instants_per_turn = times_instants * found.sampling.instants_per_turn;
  auto& body = scene.bodies[0];
  body.pressure_harmonics = found.bodies[0].pressure_harmonics + more_harmonics;
  body.pressures = found.bodies[0].pressures;
  for (auto& [port, pressure] : body.pressures) pressure.highest_harmonic += more_harmonics;
}

/// The same chamber without local refinement: even meshes, each solved anew, whose toes and walls become
/// finer from one to the next until they have so many unknowns; toes by submodels. Where a surface governs
/// that these do not resolve, such as the housing's bore: a search with cubic cells to a fifth of the
/// tolerance.
pipelines::SceneRun reference(pipelines::Scene scene) {
  constexpr std::size_t enough = 450000;
  constexpr double resolved = 0.05;
  auto run = chambers::run(scene);
  for (int step = 0; step < 6 && run.analyses.at(0).responses.n_dofs < enough; ++step) {
    const auto& analysis = run.analyses.at(0);
    if (!pipelines::refine_mesh(scene.bodies[0], analysis, analysis.place_stresses, pipelines::MeshPart::all))
      break;
    run = chambers::run(scene);
  }
  const auto governing = pipelines::governing_stress(run.analyses.at(0));
  if (governing.kind == pipelines::GoverningStress::Kind::peak && governing.relative_error() > resolved) {
    scene.bodies[0].degree = 3;
    run = chambers::run(scene, {asked / 5, 300});
  }
  return run;
}

// The stated error bounds what the reference says, and the place is right or its stress within the
// tolerance.
TEST(RandomChambers, AreBoundedByTheirStatedErrors) {
  std::mt19937 random(unsigned(from_environment("MILLSTRESS_CHAMBER_SEED", 20261122)));
  const int n_chambers = from_environment("MILLSTRESS_PROMISED_CHAMBERS", 10);
  int n = 0, n_bounded = 0, n_within = 0, n_by_halves = 0;
  while (n < n_chambers) {
    const auto drawn = chambers::small_random_chamber(random);
    const auto chamber = n % 2 == 0 ? symmetrical(drawn) : drawn;
    const results_test::Directory directory;
    pipelines::SceneRun found;
    try {
      found = chambers::run(chambers::scene_around(chamber, directory.path), {asked, 120});
    } catch (const std::exception& refused) {  // parts in each other's way: the draw allows it
      continue;
    }
    ++n;
    const auto& analysis = found.analyses.at(0);
    const auto stated = pipelines::governing_stress(analysis);
    n_by_halves += !analysis.responses.images.node.empty();
    auto scene = chambers::scene_around(chamber, directory.path);
    describe_loads_better(scene, found.loaded.scene);
    const auto finest = reference(std::move(scene));
    const auto truth = pipelines::governing_stress(finest.analyses.at(0));
    const double error = stated.value_Pa / truth.value_Pa - 1;
    const bool is_bounded = std::abs(stated.value_Pa - truth.value_Pa) <= stated.errors.numerical_Pa();
    n_bounded += is_bounded;
    n_within += std::abs(error) <= 2 * asked;
    std::printf("%2d %7zu / %7zu unknowns: %7.3f +- %5.1f %% MPa, %+5.1f %% off%s, %s; %s / %s; %s\n", n,
                analysis.responses.n_dofs, finest.analyses.at(0).responses.n_dofs, stated.value_Pa / 1e6,
                100 * stated.relative_error(), 100 * error, is_bounded ? "" : " NOT BOUNDED",
                analysis.search.met ? "met" : analysis.search.ended.c_str(), stated.place.c_str(),
                truth.place.c_str(), text(chamber).c_str());
    std::fflush(stdout);
  }
  EXPECT_GE(n_bounded, 0.97 * n);
  EXPECT_EQ(n_within, n);
  EXPECT_GE(n_by_halves, n / 2);
}

}  // namespace
