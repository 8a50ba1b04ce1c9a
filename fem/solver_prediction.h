/// What the two solvers are predicted to cost. Internal to fem.
#pragma once

#include "fem/body.h"
#include "fem/grid.h"
#include "fem/solver_choice.h"

namespace fem {

/// Largest ratio of a cell's mean edge lengths along its three axes; 1 without cells.
double largest_aspect(const Grid& grid);

/// Power laws of the number of unknowns, fitted to tests/benchmarks/shaft.toml between 50 k and 600 k on two
/// threads: good to a factor of two on bodies like it, and the errors of both go the same way on other
/// machines.
SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads);
SolverCost predict_iterative(const Grid& grid, std::size_t n_loads, double aspect);

/// Of the machine [bytes].
double physical_memory();

/// Takes the choice, or makes it: fills used, reason, predictions, aspect.
SolverReport choose_solver(const Grid& grid, const Material& material, std::size_t n_loads,
                           const SolverChoice& choice, double memory_bytes);

}  // namespace fem
