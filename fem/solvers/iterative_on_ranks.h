/// Unit responses by conjugate gradients on several MPI ranks. Internal to fem.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "fem/loads/balanced_loads.h"
#include "fem/operators/cell_materials.h"
#include "fem/operators/subdomain.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// Shares of the cells: the last rank has the trilinear level besides, which on four ranks takes the memory
/// of a quarter of the cells.
std::vector<double> weights_of_iteration(int n_ranks);

/// As solve_iteratively; every rank applies the stiffness of its own cells. Same bits in every run on the
/// same number of ranks and threads. Called on all ranks.
/// @param part   its stiffness in units of materials.largest_modulus_Pa()
/// @param loads  forces at the nodes of the part; their sizes are those of the body
/// @return displacements at the nodes of the part
/// @throws FailedTogether as CoarseOnLastRank
std::optional<Solution> solve_iteratively_on_ranks(const Grid& grid, const CellsOfNodes& cells,
                                                   const CellMaterials& materials, const RankPart& part,
                                                   const BalancedLoads& loads, const SolverChoice& choice,
                                                   const StepReport& progress, std::string& failure,
                                                   MPI_Comm communicator);

}  // namespace fem
