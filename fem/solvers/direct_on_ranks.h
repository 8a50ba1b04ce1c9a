/// Unit responses by one factorisation on several MPI ranks. Internal to fem.
#pragma once

#include <mpi.h>

#include "fem/loads/balanced_loads.h"
#include "fem/operators/cell_materials.h"

namespace fem {

/// As solve_directly, with MUMPS: every rank assembles the stiffness of its own cells and keeps its part of
/// the factor. Called on rank 0, while the others are in help_to_solve_directly.
/// @throws FailedTogether as MumpsFactor, or if rounding reaches more than 1 % of displacements
Solution solve_directly_on_ranks(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials,
                                 const BalancedLoads& loads, const StepReport& progress,
                                 MPI_Comm communicator);
void help_to_solve_directly(MPI_Comm communicator);

}  // namespace fem
