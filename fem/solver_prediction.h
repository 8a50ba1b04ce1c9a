/// What the two solvers are predicted to cost. Internal to fem.
#pragma once

#include "fem/cell_materials.h"
#include "fem/grid.h"
#include "fem/solver_choice.h"

namespace fem {

/// Largest ratio of a cell's mean edge lengths along its three axes; 1 without cells.
double largest_aspect(const Grid& grid);

/// For two threads of a quiet server core of 2023 with AVX2 (AMD EPYC; half the CPU seconds of both threads),
/// with n unknowns, N = n / 2e5, m = n / degree^3 unknowns of the trilinear level, k load cases:
///   direct      10.8 N + 12.6 N^2 + 0.03 N^1.3 k  s,   3.4e9 N^1.3  bytes
///   factorised  2e-6 n + 3 c + (8 + 2.3 aspect) (8e-8 n k + 0.25 c)  s,  c = 7 (m / 2e5)^1.75, its bytes as
///   direct of m aggregated  2e-6 n + 8e-6 m + 1.1 (8 + 2.3 aspect) 8e-8 n k  s,  1100 m bytes
/// and 215 n + 48 n (load cases of a block) bytes for both of the latter. Fitted on
/// tests/benchmarks/shaft.toml and stretched rods, aspect 2.7 to 7, 50 k to 4 M unknowns (direct: 50 k to 700
/// k). On slower machines the seconds of all grow alike, and the choice stays.
SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads);
SolverCost predict_iterative(std::size_t n_dofs, int degree, std::size_t n_loads, double aspect,
                             CoarseLevel level);

/// Whether the iterative solver is predicted to save enough to be worth an answer to its tolerance.
bool saves_time(const SolverReport& report);

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
