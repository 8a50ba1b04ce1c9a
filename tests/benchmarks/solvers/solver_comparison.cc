#include "tests/benchmarks/solvers/solver_comparison.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "fem/base/common/memory.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/solve/solvers/petsc_solver.h"
#include "fem/solve/solvers/solver_prediction.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

constexpr Eigen::Index most_loads = 12;

void silent(double, const std::string&) {}

template <typename Solve>
std::pair<fem::Solution, SolverFigures> run(const fem::SolverCost& predicted, const Solve& solve) {
  SolverFigures figures;
  fem::release_free_memory();  // of the solver before
  reset_peak();
  figures.bytes_before = memory_bytes("VmRSS:");
  const double cpu = cpu_s();
  fem::Solution solution = solve();
  figures.cpu_s = cpu_s() - cpu;
  figures.bytes = memory_bytes("VmHWM:");
  figures.predicted = predicted;
  return {std::move(solution), figures};
}

/// Balanced, those that vanish left out.
fem::BalancedLoads balanced_loads(const fem::Grid& grid, const fem::RigidBalance& rigid,
                                  Eigen::MatrixXd force) {
  const Eigen::RowVectorXd applied = force.colwise().norm();
  rigid.balance(force);
  Eigen::Index n = 0;
  for (Eigen::Index k = 0; k < force.cols() && n < most_loads; ++k)
    if (force.col(k).norm() > 1e-6 * applied[k]) force.col(n++) = force.col(k) / applied[k];
  fem::BalancedLoads loads;
  loads.force = force.leftCols(n);
  fem::move_to_masters(grid.hanging, loads.force);
  loads.norm.setOnes(n);
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
  return loads;
}

}  // namespace

SolverRow compare_solvers(const fem::Body& body, const std::vector<fem::UnitLoad>& unit_loads) {
  const auto grid = fem::make_grid(body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto colours = fem::colour_cells(grid, cells);
  const auto integrals = fem::integrate_nodes(grid, colours);
  const fem::RigidBalance rigid(grid, integrals);
  const auto loads = balanced_loads(
      grid, rigid, fem::load_vectors(grid, integrals, body.material.density_kg_m3, unit_loads));
  const auto elastic = fem::lame(body.material);
  SolverRow row;
  row.n_loads = std::size_t(loads.force.cols());
  const auto report = fem::choose_solver(grid, row.n_loads, {}, 1e15);
  row.n_dofs = grid.n_unknowns();
  row.aspect = report.largest_aspect;
  auto [iterated, iterative] = run(report.predicted_iterative, [&] {
    const fem::PetscSolver levels({MPI_COMM_SELF, grid, cells, elastic}, std::vector<int>(grid.n_nodes, 0),
                                  {}, {fem::Solver::iterative});
    return levels.solve_whole(loads, silent);
  });
  row.iterative = iterative;
  row.n_iterations = iterated.n_iterations;
  const auto size = fem::analyse_factor(grid, cells);
  if (1.2 * size.bytes > fem::free_memory()) return row;
  auto [direct, figures] = run(fem::predict_direct(size, row.n_loads), [&] {
    return fem::solve_directly(grid, cells, colours, elastic, loads, silent);
  });
  row.direct = figures;
  for (auto* u : {&iterated.displacement, &direct.displacement}) {
    fem::set_hanging_unknowns(grid.hanging, *u);
    rigid.remove_motion(*u);
  }
  row.difference = ((iterated.displacement - direct.displacement).colwise().norm().array() /
                    direct.displacement.colwise().norm().array())
                       .maxCoeff();
  return row;
}

void print_heading() {
  std::printf("CPU seconds; GB: largest resident memory of the whole process; pred: predicted\n");
  std::printf("%9s %5s %6s | %5s %11s %7s %6s %6s | %8s %7s %6s %6s | %7s\n", "unknowns", "loads", "aspect",
              "steps", "iterative s", "pred", "GB", "pred", "direct s", "pred", "GB", "pred", "apart");
}

void print_row(const SolverRow& row) {
  const auto& i = row.iterative;
  std::printf("%9zu %5zu %6.1f | %5d %11.2f %7.1f %6.2f %6.2f | ", row.n_dofs, row.n_loads, row.aspect,
              row.n_iterations, i.cpu_s, i.predicted.seconds, 1e-9 * i.bytes, 1e-9 * i.predicted.bytes);
  if (row.direct)
    std::printf("%8.2f %7.1f %6.2f %6.2f | %7.1e\n", row.direct->cpu_s, row.direct->predicted.seconds,
                1e-9 * row.direct->bytes, 1e-9 * row.direct->predicted.bytes, row.difference);
  else
    std::printf("does not fit\n");
  std::fflush(stdout);
}

}  // namespace measure
