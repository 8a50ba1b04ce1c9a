/// What a search, which refines locally, states of random chambers beside even meshes with submodels.
/// MILLSTRESS_PROMISED_CHAMBERS says how many (default 10), MILLSTRESS_CHAMBER_SEED which (the same every
/// time without it). Webs of every second one are symmetrical about its middle, and with them the whole
/// chamber.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "pipelines/analysis/fineness.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/search/refinement.h"
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
/// that the mesh does not resolve, such as the housing's bore, all cells become smaller, and more of them are
/// allowed.
pipelines::SceneRun reference(pipelines::Scene scene, const std::filesystem::path& directory) {
  constexpr std::size_t enough = 450000, most = 900000;
  constexpr double resolved = 0.05, step = 1.4;
  auto run = chambers::run(scene, directory);
  for (int n_steps = 0; n_steps < 8; ++n_steps) {
    const auto& analysis = run.analyses.at(0);
    const auto governing = pipelines::governing_stress(analysis);
    const bool is_resolved = governing.kind == pipelines::GoverningStress::Kind::hot_spot ||
                             governing.relative_error() <= resolved;
    if (analysis.responses.n_dofs >= (is_resolved ? enough : most)) break;
    auto& body = scene.bodies[0];
    if (!is_resolved && body.degree == 2)
      body.degree = 3;
    else if (!is_resolved)
      body = pipelines::with_fineness(body, step);
    else if (!pipelines::refine_mesh(body, analysis, analysis.place_stresses, pipelines::MeshPart::all))
      break;
    run = chambers::run(scene, directory);
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
      found =
          chambers::run(chambers::scene_around(chamber, directory.path), directory / "found", {asked, 120});
    } catch (const std::exception& refused) {  // parts in each other's way: the draw allows it
      continue;
    }
    ++n;
    const auto& analysis = found.analyses.at(0);
    const auto stated = pipelines::governing_stress(analysis);
    n_by_halves += !analysis.responses.images.node.empty();
    auto scene = chambers::scene_around(chamber, directory.path);
    describe_loads_better(scene, found.scene);
    const auto finest = reference(std::move(scene), directory / "reference");
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
