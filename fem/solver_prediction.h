/// What the two solvers are predicted to cost. Internal to fem.
#pragma once

#include "fem/cell_materials.h"
#include "fem/grid.h"
#include "fem/solver_choice.h"

namespace fem {

/// Largest ratio of a cell's mean edge lengths along its three axes; 1 without cells.
double largest_aspect(const Grid& grid);

/// Power laws of the number of unknowns n, with N = n / 2e5, for two threads of a machine of 2025:
///   direct     7 N^1.75 + 0.03 N^1.3 n_loads  s,   3.4e9 N^1.3  bytes
///   iterative  1.5e-6 n + c + (8 + 2.3 aspect) (3.5e-8 n n_loads + 0.05 c)  s,  c: the trilinear level's
///              factorisation, which has n / degree^3 unknowns; 300 n + 60 n loads_per_block + its factor
///              bytes
/// Fitted on shafts of 50 k to 600 k unknowns, tests/benchmarks/shaft.toml among them: good to a factor of
/// two there. On slower machines the seconds of both grow alike, and the choice stays.
SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads);
SolverCost predict_iterative(std::size_t n_dofs, int degree, std::size_t n_loads, double aspect,
                             CoarseLevel level);

/// The one predicted to be faster on cells of ordinary aspect.
CoarseLevel cheaper_coarse_level(std::size_t n_dofs, int degree, std::size_t n_loads);

/// Of the machine [bytes].
double physical_memory();

/// Of a run, beside the solver's own: mesh, loads and displacements [bytes].
double bytes_beside_solver(std::size_t n_dofs, std::size_t n_loads);

/// Takes the choice, or makes it: fills used, reason, coarse level, predictions, aspect.
/// @param memory_bytes  of the machine
/// @throws std::runtime_error naming unknowns, predicted bytes, memory and remedy if neither solver is
/// predicted to fit into memory, or the one asked for not even into a machine that holds nothing else
SolverReport choose_solver(const Grid& grid, const CellMaterials& materials, std::size_t n_loads,
                           const SolverChoice& choice, double memory_bytes);

/// @param factor_bytes  known, not predicted: CHOLMOD's analysis of the matrix tells it before it factorises
/// @throws std::runtime_error naming unknowns, bytes, memory and remedy if it does not fit into memory
void refuse_large_factor(double factor_bytes, std::size_t n_dofs, double memory_bytes);

}  // namespace fem
