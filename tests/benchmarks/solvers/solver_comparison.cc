#include "tests/benchmarks/solvers/solver_comparison.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "fem/common/memory.h"
#include "fem/common/parallel.h"
#include "fem/loads/surface_loads.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/solvers/direct_solve.h"
#include "fem/solvers/iterative_solve.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/triangulation/body_grid.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

template <typename Solve>
std::pair<fem::Solution, SolverFigures> run(const fem::SolverCost& predicted, const Solve& solve) {
  SolverFigures figures;
  fem::release_free_memory();  // of the solver before
  reset_peak();
  figures.bytes_before = memory_bytes("VmRSS:");
  const double wall = wall_s(), cpu = cpu_s();
  fem::Solution solution = solve();
  figures.cpu_s = cpu_s() - cpu;
  figures.wall_s = wall_s() - wall;
  figures.bytes = memory_bytes("VmHWM:");
  figures.predicted_s = predicted.seconds;
  figures.predicted_bytes = predicted.bytes;
  return {std::move(solution), figures};
}

}  // namespace

SolverRow compare_solvers(const fem::Body& body, const std::vector<fem::UnitLoad>& unit_loads, int n_repeats,
                          bool with_direct) {
  const auto grid = fem::make_grid(body);
  const auto silent = [](double, const std::string&) {};
  fem::BalancedLoads loads;
  {
    const auto integrals = fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid)));
    loads.force = fem::load_vectors(grid, integrals, body.material.density_kg_m3, unit_loads);
    loads.norm = loads.force.colwise().norm();
    loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
    fem::RigidBalance(grid, integrals).balance(loads.force);
  }
  fem::SolverChoice choice;
  choice.solver = fem::Solver::iterative;
  const auto report = fem::choose_solver(grid, body.material, unit_loads.size(), choice, 1e15);
  choice.coarse_level = report.coarse_level;
  SolverRow row;
  row.n_dofs = 3 * grid.n_nodes;
  row.aspect = report.largest_aspect;
  row.coarse_level = report.coarse_level == fem::CoarseLevel::aggregated ? aggregates : coarse_factor;

  Eigen::MatrixXd answer;
  for (int repeat = 0; repeat < n_repeats; ++repeat) {
    answer.resize(0, 0);
    auto [solution, figures] = run(report.predicted_iterative, [&] {
      std::string failure;
      auto found = fem::solve_iteratively(grid, body.material, loads, choice, silent, failure);
      if (!found) throw std::runtime_error(failure);
      return std::move(*found);
    });
    if (repeat == 0 || figures.cpu_s < row.iterative.cpu_s) row.iterative = figures;
    row.n_iterations = solution.n_iterations;
    answer = std::move(solution.displacement);
  }
  if (!with_direct || 1.2 * report.predicted_direct.bytes > fem::physical_memory()) return row;
  const auto cells = fem::cells_of_nodes(grid);
  const auto colours = fem::colour_cells(grid, cells);
  auto [direct, figures] = run(report.predicted_direct, [&] {
    return *fem::solve_directly(grid, cells, colours, body.material, loads, silent);
  });
  row.direct = figures;
  row.factor = direct.factor;
  const auto integrals = fem::integrate_nodes(grid, colours);
  const fem::RigidBalance rigid(grid, integrals);
  rigid.remove_motion(answer);
  rigid.remove_motion(direct.displacement);
  row.difference =
      ((answer - direct.displacement).colwise().norm().array() / direct.displacement.colwise().norm().array())
          .maxCoeff();
  return row;
}

void print_heading() {
  std::printf("CPU seconds (wall), memory: largest resident of the whole process; pred: predicted\n");
  std::printf("%9s %6s | %6s %10s %17s %6s %9s %5s %5s | %17s %6s %6s %6s | %5s %6s %7s\n", "unknowns",
              "aspect", "steps", "below", "iterative s", "pred", "us/u/case", "GB", "pred", "direct s",
              "pred", "GB", "pred", "time", "memory", "apart");
}

void print_row(const SolverRow& row, std::size_t n_loads) {
  const auto& i = row.iterative;
  std::printf("%9zu %6.1f | %6d %10s %8.2f (%6.1f) %6.1f %9.3f %5.2f %5.2f | ", row.n_dofs, row.aspect,
              row.n_iterations, row.coarse_level.c_str(), i.cpu_s, i.wall_s, i.predicted_s,
              1e6 * i.cpu_s / double(row.n_dofs) / double(n_loads), 1e-9 * i.bytes, 1e-9 * i.predicted_bytes);
  if (row.direct) {
    const auto& d = *row.direct;
    std::printf("%8.2f (%6.1f) %6.1f %6.2f %6.2f | %5.2f %6.3f %7.1e\n", d.cpu_s, d.wall_s, d.predicted_s,
                1e-9 * d.bytes, 1e-9 * d.predicted_bytes, d.cpu_s / i.cpu_s,
                (i.bytes - i.bytes_before) / (d.bytes - d.bytes_before), row.difference);
  } else {
    std::printf("left out\n");
  }
  std::fflush(stdout);
}

}  // namespace measure
