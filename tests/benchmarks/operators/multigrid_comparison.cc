#include "tests/benchmarks/operators/multigrid_comparison.h"

#include <deal.II/grid/tria.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/common/memory.h"
#include "fem/loads/surface_loads.h"
#include "fem/mesh/hanging_nodes.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/operators/stiffness.h"
#include "fem/solvers/direct_solve.h"
#include "fem/solvers/iterative_solve.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/triangulation/body_grid.h"
#include "fem/triangulation/local_refinement.h"
#include "fem/triangulation/manifolds.h"
#include "fem/triangulation/triangulation.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/benchmarks/operators/dealii_operator.h"
#include "tests/benchmarks/operators/wide_multigrid.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

/// Smoother and range: deal.II's usual ones, and those for stretched cells.
const MultigridControl controls[] = {{5, 20}, {8, 60}};  // at most MultigridControl::max_steps for each load
constexpr Eigen::Index most_loads = 12;                  // of a body: what fits into two registers of ours
/// Of displacements. Residuals end at 1e-10 of the load; slender bodies turn that into more.
constexpr double same_answer = 1e-6;

decltype(&solve_by_wide_multigrid) multigrid_of_this_machine() {
  const char* file = nullptr;
#if defined(MULTIGRID_AVX512)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    file = MULTIGRID_AVX512;
#endif
#if defined(MULTIGRID_AVX2)
  if (file == nullptr && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    file = MULTIGRID_AVX2;
#endif
  if (file == nullptr)
    throw std::runtime_error("deal.II's multigrid is compared on machines with AVX2 or AVX-512");
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  void* const function = library ? dlsym(library, "solve_by_wide_multigrid") : nullptr;
  if (!function) throw std::runtime_error(std::string("deal.II's multigrid: ") + dlerror());
  return reinterpret_cast<decltype(&solve_by_wide_multigrid)>(function);
}

struct Row {
  const char* method;
  std::string steps, levels;
  double set_up_s = 0, solve_s = 0;
};

void print(const std::string& body, std::size_t n_dofs, Eigen::Index n_loads, const Row& row, double apart) {
  std::printf("| %s | %zu | %d | %s | %s | %.2f | %.2f | %.2f | %s | ", body.c_str(), n_dofs, int(n_loads),
              row.method, row.steps.c_str(), row.set_up_s, row.solve_s, row.set_up_s + row.solve_s,
              row.levels.c_str());
  if (apart > 0)
    std::printf("%.0e |\n", apart);
  else
    std::printf("|\n");
  std::fflush(stdout);
}

/// Largest difference of a load's displacements, by the largest displacement.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return ((a - b).colwise().lpNorm<Eigen::Infinity>().array() / b.colwise().lpNorm<Eigen::Infinity>().array())
      .maxCoeff();
}

void compare(const std::string& name, const fem::Body& body, const std::vector<fem::UnitLoad>& unit_loads) {
  const OneThread alone;
  const auto silent = [](double, const std::string&) {};
  const auto grid = fem::make_grid(body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto colours = fem::colour_cells(grid, cells);
  const auto integrals = fem::integrate_nodes(grid, colours);
  const fem::RigidBalance rigid(grid, integrals);
  fem::BalancedLoads loads;
  loads.force = fem::load_vectors(grid, integrals, body.material.density_kg_m3, unit_loads);
  // Uniform accelerations balance to nothing, and such loads are left out.
  const Eigen::RowVectorXd applied = loads.force.colwise().norm();
  rigid.balance(loads.force);
  fem::move_to_masters(grid.hanging, loads.force);
  Eigen::Index n_loads = 0;
  for (Eigen::Index k = 0; k < loads.force.cols(); ++k)
    if (loads.force.col(k).norm() > 1e-6 * applied[k])
      loads.force.col(n_loads++) = loads.force.col(k) / applied[k];
  n_loads = std::min(n_loads, most_loads);
  loads.force.conservativeResize(Eigen::NoChange, n_loads);
  loads.norm = loads.force.colwise().norm();
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
  const auto motion_free = [&](Eigen::MatrixXd displacement) {
    fem::set_hanging_unknowns(grid.hanging, displacement);
    rigid.remove_motion(displacement);
    return displacement;
  };

  Row row{"factor", "", "", 0, 0};
  double start_s = cpu_s();
  auto direct = fem::solve_directly(grid, cells, colours, body.material, loads, silent);
  row.solve_s = cpu_s() - start_s;
  const auto answer = motion_free(std::move(direct->displacement));
  print(name, grid.n_unknowns(), n_loads, row, 0);

  row = {"our iteration", "", "", 0, 0};
  fem::SolverChoice choice;
  choice.solver = fem::Solver::iterative;
  choice.max_iterations *= fem::patience;
  choice.coarse_level =
      fem::choose_solver(grid, body.material, std::size_t(n_loads), choice, 1e15).coarse_level;
  start_s = cpu_s();
  std::string failure;
  auto found = fem::solve_iteratively(grid, body.material, loads, choice, silent, failure);
  row.solve_s = cpu_s() - start_s;
  row.steps = found ? std::to_string(found->n_iterations) : failure;
  print(name, grid.n_unknowns(), n_loads, row,
        found ? difference(motion_free(std::move(found->displacement)), answer) : 0);

  dealii::Triangulation<3> mesh(dealii::Triangulation<3>::limit_level_difference_at_vertices);
  fem::triangulate(*body.mesh, mesh);
  fem::attach_charts(mesh, body.cylinders, body.tori);
  fem::refine_locally(mesh, body.refinements);
  const auto elastic = fem::lame(body.material);
  const MultigridProblem problem{
      &mesh, &grid, elastic.lambda_Pa, elastic.mu_Pa, std::size_t(n_loads), loads.force.data()};
  for (const auto& control : controls) {
    MultigridAnswer other;
    multigrid_of_this_machine()(problem, control, other);
    const auto method = "deal.II, " + std::to_string(other.n_lanes) + " lanes, degree " +
                        std::to_string(control.smoother_degree) + ", range " +
                        std::to_string(int(control.smoothing_range));
    row = {method.c_str(), (other.converged ? "" : "> ") + std::to_string(other.n_steps), "",
           other.set_up_cpu_s, other.solve_cpu_s};
    for (const auto n : other.n_dofs) row.levels += (row.levels.empty() ? "" : ", ") + std::to_string(n);
    const double apart = difference(motion_free(Eigen::Map<Eigen::MatrixXd>(
                                        other.displacement.data(), 3 * Eigen::Index(grid.n_nodes), n_loads)),
                                    answer);
    print(name, grid.n_unknowns(), n_loads, row, apart);
    if (other.converged && !(apart < same_answer))
      throw std::runtime_error("displacements of deal.II's multigrid and of our factor differ");
  }
}

}  // namespace

void compare_multigrid(const std::filesystem::path& shaft_toml, const std::filesystem::path& mill_toml) {
  std::printf(
      "CPU seconds on one thread\n"
      "| body | unknowns | loads | method | steps | set-up | solve | together | unknowns of levels | apart "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  const auto shaft = pipelines::read_scene(shaft_toml);
  for (const Refinement& refinement : {Refinement{2, 16}, Refinement{4, 28}}) {
    const auto part = refined_shaft(shaft, refinement);
    const auto mesh = pipelines::build_mesh(part);
    compare("even shaft", pipelines::to_fem_body(mesh, part.material), seat_loads(mesh));
  }
  const auto folder = std::filesystem::temp_directory_path() / ("multigrid-" + std::to_string(getpid()));
  pipelines::SceneRunOptions options;
  options.directory = folder;
  options.keep = false;
  options.fresh = true;
  options.n_threads = 2;
  options.accuracy.tolerance = 0.05;
  pipelines::StageClock clock;
  const auto run = pipelines::run_scene(pipelines::read_scene(mill_toml), options, clock);
  std::filesystem::remove_all(folder);
  for (const auto& analysis : run.analyses) {
    auto body = pipelines::to_fem_body(analysis.mesh, analysis.scene.material);
    body.refinements = analysis.scene.refinements;
    compare(analysis.scene.name + " of the mill, refined", body, analysis.loads.unit_loads);
  }
}

}  // namespace measure
