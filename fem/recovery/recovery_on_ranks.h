/// Stress at the nodes, recovered by several MPI ranks. Internal to fem.
#pragma once

#include <mpi.h>

#include <vector>

#include "fem/mesh/grid.h"
#include "fem/operators/stiffness.h"
#include "fem/recovery/stress_recovery.h"
#include "fem/values/body.h"

namespace fem {

/// Stress at all nodes of a mesh by patches, or by averages of the cells.
/// @param loaded_groups  boundary groups that any load acts on
/// @param stress  n_nodes x 6 K, overwritten
void recover_stress(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                    const std::vector<CylinderChart>& charts, const std::vector<int>& loaded_groups,
                    bool by_patches, const ConstBlock& displacement, Eigen::Ref<RowMajor> stress,
                    const NodeSelection& selection = {});

/// The same; every rank does the nodes that it counts, on its cells and as many layers around them as these
/// nodes' patches reach: the same steps as on one rank. Called on rank 0, while the others are in
/// help_to_recover_stress.
/// @param stress_Pa  n_nodes x 6 K; made once the ranks have recovered
void recover_stress_on_ranks(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                             const std::vector<CylinderChart>& charts, const std::vector<int>& loaded_groups,
                             bool by_patches, const ConstBlock& displacement, std::vector<double>& stress_Pa,
                             MPI_Comm communicator);
void help_to_recover_stress(MPI_Comm communicator);

}  // namespace fem
