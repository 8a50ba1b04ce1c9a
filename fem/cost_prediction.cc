#include "fem/cost_prediction.h"

#include "fem/cell_materials.h"
#include "fem/mesh_reader.h"
#include "fem/solver_prediction.h"

namespace fem {

SolverReport predict_solver(const Body& body, std::size_t n_loads, const SolverChoice& choice) {
  const Grid grid = read_grid(body);
  return choose_solver(grid, CellMaterials(grid, body), n_loads, choice, physical_memory());
}

SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice) {
  SolverReport report = at_hand;
  const bool iterative_is_faster = saves_time(at_hand);
  report.predicted_direct = predict_direct(n_dofs, n_loads);
  if (at_hand.predicted_iterative.seconds == 0) return report;  // it does not suit the cells
  if (choice.coarse_level == CoarseLevel::automatic)
    report.coarse_level = cheaper_coarse_level(n_dofs, degree, n_loads);
  report.predicted_iterative =
      predict_iterative(n_dofs, degree, n_loads, report.largest_aspect, report.coarse_level);
  const bool cost_decided = (at_hand.used == Solver::iterative) == iterative_is_faster;
  if (choice.solver == Solver::automatic && cost_decided)
    report.used = saves_time(report) ? Solver::iterative : Solver::direct;
  return report;
}

}  // namespace fem
