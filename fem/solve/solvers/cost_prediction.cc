#include "fem/solve/solvers/cost_prediction.h"

#include "fem/base/common/memory.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/solve/solvers/mirrored_halves.h"
#include "fem/solve/solvers/solver_prediction.h"

namespace fem {

namespace {

FactorSize twice(const FactorSize& size) {
  return {2 * size.n_dofs, 2 * size.entries, 2 * size.flops, 2 * size.bytes};
}

/// The solver that is used where nobody asks for one, on a machine that holds nothing else.
void choose_by_memory(std::size_t n_dofs, std::size_t n_loads, const SolverChoice& choice,
                      SolverReport& report) {
  if (choice.solver != Solver::automatic || report.predicted_iterative.bytes == 0) return;
  const double left = physical_memory() - bytes_beside_solver(n_dofs, n_loads);
  report.used = report.predicted_direct.bytes > left ? Solver::iterative : Solver::direct;
}

}  // namespace

SolverReport predict_solver(const Grid& grid, const CellsOfNodes& cells, const MirroredHalf* half,
                            std::size_t n_loads, const SolverChoice& choice) {
  constexpr std::size_t most_analysed = 600'000;  // seconds
  auto report = choose_solver(grid, n_loads, choice, physical_memory());
  if (report.used == Solver::direct && 3 * grid.n_nodes <= most_analysed) {
    report.factor =
        half != nullptr ? twice(analyse_factor(half->grid(), half->cells())) : analyse_factor(grid, cells);
    report.predicted_direct = predict_direct(report.factor, n_loads);
  }
  choose_by_memory(grid.n_unknowns(), n_loads, choice, report);
  return report;
}

SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice) {
  SolverReport report = at_hand;
  if (at_hand.factor.n_dofs > 0) report.factor = scaled(at_hand.factor, n_dofs);
  report.predicted_direct =
      at_hand.factor.n_dofs > 0 ? predict_direct(report.factor, n_loads) : predict_direct(n_dofs, n_loads);
  if (degree > 1) report.predicted_iterative = predict_iterative(n_dofs, n_loads, report.largest_aspect);
  choose_by_memory(n_dofs, n_loads, choice, report);
  return report;
}

SolverReport predict_solver(std::size_t n_dofs, int degree, bool tetrahedra, std::size_t n_loads,
                            const SolverChoice& choice) {
  constexpr double usual_aspect = 6;
  SolverReport at_hand;
  at_hand.largest_aspect = tetrahedra ? 0 : usual_aspect;
  if (degree > 1 && choice.solver == Solver::iterative) at_hand.used = Solver::iterative;
  return predict_solver(at_hand, n_dofs, degree, n_loads, choice);
}

}  // namespace fem
