/// The solvers of unit responses on the shaft of shaft.toml, refined evenly: twelve load cases directly and
/// iteratively, and the operator against deal.II's and a sparse matrix. Ratios of one run.
///   solver_benchmarks <shaft.toml> [largest number of unknowns, default 700000] [picture.svg]
///       [largest number for the direct solver, default: what fits into memory]
///   solver_benchmarks <shaft.toml> operator
/// The operator alone.
///   solver_benchmarks <shaft.toml> fit [largest number of unknowns, default 700000]
/// Twelve load cases at the same sizes, and with stretched cells at the smaller ones: the constants of
/// fem/values/cost_constants.h, fitted anew.
///   solver_benchmarks <shaft.toml> triangulations
/// Cells and numbers of nodes by deal.II's serial triangulation and by p4est's.
///   solver_benchmarks <shaft.toml> multigrid <vibratory_mill.toml>
/// Our solvers beside deal.II's global-coarsening multigrid.
///   solver_benchmarks <vibratory_mill.toml> halves
/// The scene's chamber whole and by halves.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "fem/model/model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/benchmarks/operators/multigrid_comparison.h"
#include "tests/benchmarks/operators/operator_comparison.h"
#include "tests/benchmarks/operators/triangulations.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/benchmarks/solvers/cost_fit.h"
#include "tests/benchmarks/solvers/halves.h"
#include "tests/benchmarks/solvers/solver_comparison.h"
#include "tests/benchmarks/solvers/solver_plot.h"

namespace {

constexpr int n_threads = 2;
constexpr int n_repeats_small = 3;
constexpr std::size_t small = 300000;  // unknowns: solved several times

struct Size {
  std::size_t n_dofs;  // about
  measure::Refinement refinement;
};
const Size sizes[] = {
    {65000, {2, 16}}, {230000, {4, 28}}, {670000, {4, 40}}, {1460000, {6, 52}}, {4010000, {8, 72}}};
constexpr double stretches[] = {1.5, 2};
constexpr std::size_t most_when_unasked = 700000;

/// Its middle segment alone, extruded, without ports.
pipelines::BodyScene extruded(pipelines::BodyScene part) {
  auto& shaft = std::get<pipelines::ShaftShape>(part.shape).geometry;
  shaft.segments = {shaft.segments.at(1)};
  shaft.fillets_m.clear();
  return part;
}

void fit(const char* scene_file, std::size_t most) {
  const auto scene = pipelines::read_scene(scene_file);
  std::vector<measure::SolverRow> rows;
  std::size_t n_loads = 0;
  const auto add = [&](const Size& size) {
    const auto part = measure::refined_shaft(scene, size.refinement);
    const auto mesh = pipelines::build_mesh(part);
    const auto loads = measure::seat_loads(mesh);
    n_loads = loads.size();
    rows.push_back(measure::compare_solvers(pipelines::to_fem_body(mesh, part.material), loads,
                                            size.n_dofs < small ? n_repeats_small : 1, true));
    measure::print_row(rows.back(), n_loads);
  };
  measure::print_heading();
  for (auto size : sizes) {
    if (size.n_dofs > most) break;
    add(size);
    if (size.n_dofs > small) continue;
    for (const double stretch : stretches) {
      size.refinement.stretch = stretch;
      add(size);
    }
  }
  measure::print_fit(rows, n_loads);
}

void compare_operators(const char* scene_file) {
  const auto scene = pipelines::read_scene(scene_file);
  const auto body_of = [&](const pipelines::BodyScene& part) {
    return pipelines::to_fem_body(pipelines::build_mesh(part), part.material);
  };
  const auto middle = body_of(extruded(measure::refined_shaft(scene, {4, 28})));
  measure::compare_operators("extruded", middle, false);
  measure::compare_operators("distorted", middle, true);
  const auto whole = body_of(measure::refined_shaft(scene, {4, 28}));
  measure::compare_operators("stepped shaft with fillets", whole, false);
}

void run(const char* scene_file, std::size_t most, std::size_t most_direct,
         const std::filesystem::path& picture) {
  compare_operators(scene_file);

  const auto scene = pipelines::read_scene(scene_file);
  measure::print_heading();
  std::vector<measure::SolverRow> rows;
  for (const auto& size : sizes) {
    if (size.n_dofs > most) break;
    const auto part = measure::refined_shaft(scene, size.refinement);
    const auto mesh = pipelines::build_mesh(part);
    const auto loads = measure::seat_loads(mesh);
    rows.push_back(measure::compare_solvers(pipelines::to_fem_body(mesh, part.material), loads,
                                            size.n_dofs < small ? n_repeats_small : 1,
                                            size.n_dofs <= most_direct));
    measure::print_row(rows.back(), loads.size());
  }
  measure::write_solver_plot(picture, rows);
  std::printf("%s\n", picture.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: solver_benchmarks <shaft.toml> [largest number of unknowns] [picture.svg] [largest "
                 "for the direct solver]\n       solver_benchmarks <shaft.toml> operator\n       "
                 "solver_benchmarks <shaft.toml> fit [largest number of "
                 "unknowns]\n       solver_benchmarks <shaft.toml> triangulations\n       "
                 "solver_benchmarks <shaft.toml> multigrid <vibratory_mill.toml>\n       "
                 "solver_benchmarks <vibratory_mill.toml> halves\n");
    return 2;
  }
  const fem::Environment environment(n_threads);
  int code = 0;
  try {
    if (argc > 2 && std::string(argv[2]) == "fit")
      fit(argv[1], argc > 3 ? std::size_t(std::atof(argv[3])) : most_when_unasked);
    else if (argc > 2 && std::string(argv[2]) == "operator")
      compare_operators(argv[1]);
    else if (argc > 2 && std::string(argv[2]) == "triangulations")
      measure::compare_triangulations(argv[1]);
    else if (argc > 3 && std::string(argv[2]) == "multigrid")
      measure::compare_multigrid(argv[1], argv[3]);
    else if (argc > 2 && std::string(argv[2]) == "halves")
      measure::compare_halves(argv[1]);
    else
      run(argv[1], argc > 2 ? std::size_t(std::atof(argv[2])) : most_when_unasked,
          argc > 4 ? std::size_t(std::atof(argv[4])) : 100000000,
          argc > 3 ? argv[3] : "results/benchmarks/solvers.svg");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  return code;
}
