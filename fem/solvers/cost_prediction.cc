#include "fem/solvers/cost_prediction.h"

#include "fem/common/memory.h"
#include "fem/operators/cell_materials.h"
#include "fem/solvers/direct_solve.h"
#include "fem/solvers/mirrored_halves.h"
#include "fem/solvers/solver_prediction.h"

namespace fem {

namespace {

FactorSize twice(const FactorSize& size) {
  return {2 * size.n_dofs, 2 * size.entries, 2 * size.flops, 2 * size.bytes};
}

}  // namespace

SolverReport predict_solver(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials,
                            const MirroredHalf* half, std::size_t n_loads, const SolverChoice& choice) {
  constexpr std::size_t most_analysed = 600'000;  // seconds
  auto report = choose_solver(grid, materials, n_loads, choice, physical_memory());
  if (report.used == Solver::direct && 3 * grid.n_nodes <= most_analysed) {
    report.factor =
        half != nullptr ? twice(analyse_factor(half->grid(), half->cells())) : analyse_factor(grid, cells);
    report.predicted_direct = predict_direct(report.factor, n_loads);
    if (is_too_expensive(report.factor, report, n_loads)) report.used = Solver::iterative;
  }
  return report;
}

SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice) {
  SolverReport report = at_hand;
  const bool iterative_is_faster = saves_time(at_hand);
  if (at_hand.factor.n_dofs > 0) report.factor = scaled(at_hand.factor, n_dofs);
  report.predicted_direct =
      at_hand.factor.n_dofs > 0 ? predict_direct(report.factor, n_loads) : predict_direct(n_dofs, n_loads);
  const bool suits = suits_multigrid(at_hand.largest_aspect);
  if (at_hand.predicted_iterative.seconds == 0 || !(suits || at_hand.by_analysis)) return report;
  if (choice.coarse_level == CoarseLevel::automatic)
    report.coarse_level = cheaper_coarse_level(n_dofs, degree, n_loads);
  report.predicted_iterative =
      predict_iterative(n_dofs, degree, n_loads, report.largest_aspect, report.coarse_level);
  if (at_hand.by_analysis) {
    const bool expensive = report.factor.n_dofs > 0 && is_too_expensive(report.factor, report, n_loads);
    report.used = expensive ? Solver::iterative : Solver::direct;
    return report;
  }
  const bool cost_decided = (at_hand.used == Solver::iterative) == iterative_is_faster;
  if (choice.solver == Solver::automatic && cost_decided)
    report.used = saves_time(report) ? Solver::iterative : Solver::direct;
  return report;
}

SolverReport predict_solver(std::size_t n_dofs, int degree, bool tetrahedra, std::size_t n_loads,
                            const SolverChoice& choice) {
  constexpr double usual_aspect = 6;
  SolverReport report;
  report.predicted_direct = predict_direct(n_dofs, n_loads);
  if (tetrahedra || degree < 2) return report;
  report.largest_aspect = usual_aspect;
  report.coarse_level = cheaper_coarse_level(n_dofs, degree, n_loads);
  report.predicted_iterative = predict_iterative(n_dofs, degree, n_loads, usual_aspect, report.coarse_level);
  report.used = choice.solver != Solver::automatic ? choice.solver
                : saves_time(report)               ? Solver::iterative
                                                   : Solver::direct;
  return report;
}

}  // namespace fem
