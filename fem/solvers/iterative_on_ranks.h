/// Unit responses by conjugate gradients on several MPI ranks. Internal to fem.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>

#include "fem/loads/balanced_loads.h"
#include "fem/operators/cell_materials.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// As solve_iteratively; every rank applies the stiffness of its own cells. Same bits in every run on the
/// same number of ranks and threads. Called on rank 0, while the others are in help_to_solve_iteratively.
/// @param loads  forces are given away: there again only if there is no solution
/// @throws FailedTogether as CoarseOnLastRank
std::optional<Solution> solve_iteratively_on_ranks(const Grid& grid, const CellsOfNodes& cells,
                                                   const CellMaterials& materials, BalancedLoads& loads,
                                                   const SolverChoice& choice, const StepReport& progress,
                                                   std::string& failure, MPI_Comm communicator);
void help_to_solve_iteratively(MPI_Comm communicator);

}  // namespace fem
