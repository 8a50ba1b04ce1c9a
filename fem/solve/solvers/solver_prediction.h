/// What the two solvers are predicted to cost, and which one is taken. Internal to fem.
#pragma once

#include <string>

#include "fem/base/values/solver_choice.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

class MirroredHalf;

/// Largest ratio of the longest to the shortest of a cell's mean edge lengths along its three axes; 1 without
/// cells, 0 for tetrahedra.
double largest_aspect(const Grid& grid);

/// With the constants of base/values/cost_constants.h, which says on what they are fitted, N = n_dofs / 2e5,
/// k load cases:
///   direct_s_linear N + direct_s_square N^2 + direct_s_per_load N^1.3 k  s,  direct_bytes N^1.3  bytes
SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads);

/// The same of a matrix that was analysed, for a body of any shape, with recovery: factor_s_per_dof n +
/// factor_s_per_flop flops + (factor_s_per_entry entries + factor_s_per_response n) k seconds; its bytes.
SolverCost predict_direct(const FactorSize& factor, std::size_t n_loads);

/// The factor of n_dofs unknowns in a body of the same shape: flops grow as n^2, entries as n^(4/3).
FactorSize scaled(const FactorSize& factor, std::size_t n_dofs);

///   (iteration_setup_s_per_dof + steps iteration_s_per_dof k) n  s,  iteration_bytes_per_dof n  bytes,
///   steps = iteration_steps + iteration_steps_per_aspect aspect
/// @param aspect  largest_aspect
SolverCost predict_iterative(std::size_t n_dofs, std::size_t n_loads, double aspect);

/// Cells of rank 0 to one of each other rank's, so that rank 0, which has the factor of the iteration's lower
/// level, needs no more memory than they do; at least a twentieth.
double cells_of_first_rank(std::size_t n_dofs, int n_ranks);

/// Memory of a run beside the solver's own: mesh, loads and displacements [bytes].
double bytes_beside_solver(std::size_t n_dofs, std::size_t n_loads);

/// Takes the choice: fills used, reason, predictions, aspect. Where it is automatic the factor is used, until
/// turn_to_iteration.
/// @throws DoesNotFit if the iteration is asked for and does not fit
SolverReport choose_solver(const Grid& grid, std::size_t n_loads, const SolverChoice& choice,
                           double memory_bytes);

/// Whether nobody asked for the factor and the mesh has a coarser level.
inline bool may_turn_to_iteration(const SolverChoice& choice, const SolverReport& report) {
  return choice.solver == Solver::automatic && report.predicted_iterative.bytes > 0;
}

/// After the factor turned out not to fit.
/// @param memory_bytes  that are left
/// @throws DoesNotFit naming unknowns, bytes, memory and remedy if the iteration does not fit either
void turn_to_iteration(std::size_t n_dofs, double memory_bytes, SolverReport& report);

/// After the iteration did not end.
/// @param failure  what it said; remedies behind a semicolon are not for the report
void turn_to_factor(const std::string& failure, SolverReport& report);

/// As choose_solver, with this machine's memory; where the factor may be used and the body is small enough,
/// after an analysis of the matrix. Solves nothing.
/// @param half  of a body that is solved by halves, or null; loads are taken to have parts of both parities
/// @throws DoesNotFit as choose_solver
SolverReport predict_solver(const Grid& grid, const CellsOfNodes& cells, const MirroredHalf* half,
                            std::size_t n_loads, const SolverChoice& choice);

/// @param factor_bytes  known, not predicted: CHOLMOD's analysis of the matrix tells it before it factorises
/// @param memory_bytes  that are left for it
/// @throws DoesNotFit naming unknowns, bytes, memory and remedy if it does not fit into memory
void refuse_large_factor(double factor_bytes, std::size_t n_dofs, double memory_bytes);

}  // namespace fem
