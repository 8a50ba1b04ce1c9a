/// What the two solvers are predicted to cost. Internal to fem.
#pragma once

#include <string>
#include <vector>

#include "fem/matrices/cholmod_factor.h"
#include "fem/mesh/grid.h"
#include "fem/operators/cell_materials.h"
#include "fem/values/solver_choice.h"

namespace fem {

class MirroredHalf;

/// Ratio of the longest to the shortest of a cell's mean edge lengths along its three axes, for each cell;
/// empty for tetrahedra.
std::vector<double> aspects(const Grid& grid);

/// Of all cells: those that suits_multigrid refuses.
double share_stretched(const Grid& grid);

/// The largest of them; 1 without cells, 0 for tetrahedra.
double largest_aspect(const Grid& grid);

/// With the constants of values/cost_constants.h, which says on what they are fitted, n unknowns,
/// N = n / 2e5, m = n / degree^3 unknowns of the trilinear level, k load cases:
///   direct      direct_s_linear N + direct_s_square N^2 + direct_s_per_load N^1.3 k  s,
///               direct_bytes N^1.3  bytes
///   iterative   setup + steps (iteration_s_per_dof n K + below)  s,  steps = iterations_first +
///               iterations_per_aspect aspect; (iterative_bytes_per_dof + iterative_bytes_per_lane (load
///               cases of a block)) n  bytes and those of the level below
/// K is k filled up to a multiple of 4, which the operator works on at once. The level below is a factor of m
/// unknowns, with the seconds coarse_factor_s (m / 2e5)^1.75, or aggregates of m unknowns. On slower machines
/// the seconds of all grow alike, and the choice stays.
SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads);

/// The same of a matrix that was analysed, for a body of any shape, with recovery: factor_s_per_dof n +
/// factor_s_per_flop flops + (factor_s_per_entry entries + factor_s_per_response n) k seconds; its bytes.
SolverCost predict_direct(const FactorSize& factor, std::size_t n_loads);

/// Of n_dofs unknowns in a body of the same shape: flops grow as n^2, entries as n^(4/3).
FactorSize scaled(const FactorSize& factor, std::size_t n_dofs);
SolverCost predict_iterative(std::size_t n_dofs, int degree, std::size_t n_loads, double aspect,
                             CoarseLevel level);

/// Whether the cells are compact enough for the smoother, which is pointwise.
bool suits_multigrid(double aspect);

/// Whether an analysed factor is predicted to cost more than twice what the iteration does on cells of
/// middling stretch, whose number of iterations is known less well.
bool is_too_expensive(const FactorSize& factor, const SolverReport& report, std::size_t n_loads);

/// Whether stretched cells may be iterated where the factor does not fit into memory: at most half of them
/// beyond 1 : 12 (a third of a stepped shaft's cells, up to 1 : 39: 95 iterations), so that it may take up to
/// patience times SolverChoice::max_iterations.
/// @param memory_bytes  that are left
bool may_be_iterated(const Grid& grid, const CellMaterials& materials, const SolverChoice& choice,
                     const SolverReport& report, double memory_bytes);

/// Whether the iterative solver is predicted to save enough to be worth an answer to its tolerance.
bool saves_time(const SolverReport& report);

/// The one predicted to be faster on cells of ordinary aspect.
CoarseLevel cheaper_coarse_level(std::size_t n_dofs, int degree, std::size_t n_loads);

/// Of a run, beside the solver's own: mesh, loads and displacements [bytes].
double bytes_beside_solver(std::size_t n_dofs, std::size_t n_loads);

/// Takes the choice, or makes it: fills used, reason, coarse level, predictions, aspect.
/// @param memory_bytes  of the machine
/// @throws DoesNotFit naming unknowns, predicted bytes, memory and remedy if neither solver is
/// predicted to fit into memory, or the one asked for not even into a machine that holds nothing else
SolverReport choose_solver(const Grid& grid, const CellMaterials& materials, std::size_t n_loads,
                           const SolverChoice& choice, double memory_bytes);

/// After the iteration has given up.
/// @param failure  what happened
void turn_to_factor(const std::string& failure, SolverReport& report);

/// As choose_solver, with this machine's memory; where it is direct and small enough, after an analysis of
/// the matrix. Solves nothing.
/// @param half  of a body that is solved by halves, or null; loads are taken to have parts of both parities
/// @throws DoesNotFit as choose_solver
SolverReport predict_solver(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials,
                            const MirroredHalf* half, std::size_t n_loads, const SolverChoice& choice);

/// @param factor_bytes  known, not predicted: CHOLMOD's analysis of the matrix tells it before it factorises
/// @param memory_bytes  that are left for it
/// @throws DoesNotFit naming unknowns, bytes, memory and remedy if it does not fit into memory
void refuse_large_factor(double factor_bytes, std::size_t n_dofs, double memory_bytes);

}  // namespace fem
