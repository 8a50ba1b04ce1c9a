/// Unit responses by one factorisation on several MPI ranks. Internal to fem.
#pragma once

#include <mpi.h>

#include "fem/loads/balanced_loads.h"
#include "fem/operators/cell_materials.h"
#include "fem/operators/subdomain.h"

namespace fem {

/// As solve_directly, with MUMPS: every rank assembles the stiffness of its own cells and keeps its part of
/// the factor; MUMPS wants right-hand sides and solutions on rank 0. Called on all ranks.
/// @param part   its stiffness in Pa
/// @param loads  forces at the nodes of the part; their sizes are those of the body
/// @return displacements at the nodes of the part
/// @throws FailedTogether as MumpsFactor, or if rounding reaches more than 1 % of displacements
Solution solve_directly_on_ranks(const Grid& grid, const CellsOfNodes& cells, const RankPart& part,
                                 const BalancedLoads& loads, const StepReport& progress,
                                 MPI_Comm communicator);

/// Nodal forces of the whole body on rank 0, from those that each rank counts. Called on all ranks.
/// @return 3 n_nodes x loads; empty on the others
Eigen::MatrixXd on_first(const Grid& grid, const RankPart& part, const Eigen::MatrixXd& own,
                         MPI_Comm communicator);

/// Displacements at the nodes of the part, from those of the whole body on rank 0. Called on all ranks.
Eigen::MatrixXd from_first(const Grid& grid, const RankPart& part, const Eigen::MatrixXd& whole,
                           Eigen::Index n_columns, MPI_Comm communicator);

}  // namespace fem
