/// The solvers of unit responses, directly and iteratively: steps, seconds, memory, how far apart.
///   solver_benchmarks <shaft.toml> [largest number of unknowns, default 300000]
/// Twelve load cases of the shaft, refined evenly.
///   solver_benchmarks <scene.toml> scene [tolerance, default 0.05]
/// The unit loads of the scene's bodies on the mesh of its [mesh] table (tolerance 0), or as a search for the
/// tolerance leaves them.
///   solver_benchmarks <vibratory_mill.toml> halves
/// The scene's chamber whole and by halves.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "fem/models/solid/model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/benchmarks/solvers/halves.h"
#include "tests/benchmarks/solvers/solver_comparison.h"

namespace {

constexpr int n_threads = 2;

struct Size {
  std::size_t n_dofs;  // about
  measure::Refinement refinement;
};
const Size sizes[] = {
    {65000, {2, 16}}, {230000, {4, 28}}, {670000, {4, 40}}, {1460000, {6, 52}}, {4010000, {8, 72}}};

void refine_evenly(const char* scene_file, std::size_t most) {
  const auto scene = pipelines::read_scene(scene_file);
  measure::print_heading();
  for (const auto& size : sizes) {
    if (size.n_dofs > most) break;
    const auto part = measure::refined_shaft(scene, size.refinement);
    const auto mesh = pipelines::build_mesh(part);
    measure::print_row(
        measure::compare_solvers(pipelines::to_fem_body(mesh, part.material), measure::seat_loads(mesh)));
  }
}

void bodies_of_scene(const char* scene_file, double tolerance) {
  pipelines::SceneRunOptions options;
  options.cache = false;
  options.fresh = true;
  options.n_threads = n_threads;
  options.accuracy.once = tolerance == 0;
  if (tolerance > 0) {
    options.accuracy.tolerance = tolerance;
    options.accuracy.time_limit_s = 900;
  }
  pipelines::StageClock clock;
  const auto run = pipelines::run_scene(pipelines::read_scene(scene_file), options, clock);
  measure::print_heading();
  for (const auto& analysis : run.analyses) {
    auto body = pipelines::to_fem_body(analysis.mesh, analysis.scene.material);
    body.refinements = analysis.scene.refinements;
    measure::print_row(measure::compare_solvers(body, analysis.loads.unit_loads));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: solver_benchmarks <shaft.toml> [largest number of unknowns]\n       "
                 "solver_benchmarks <scene.toml> scene [tolerance]\n       "
                 "solver_benchmarks <vibratory_mill.toml> halves\n");
    return 2;
  }
  const fem::Environment environment(n_threads);
  const std::string what = argc > 2 ? argv[2] : "300000";
  try {
    if (what == "halves")
      measure::compare_halves(argv[1]);
    else if (what == "scene")
      bodies_of_scene(argv[1], argc > 3 ? std::atof(argv[3]) : 0.05);
    else
      refine_evenly(argv[1], std::size_t(std::atof(what.c_str())));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
