/// Stress at the nodes of a whole body. Internal to fem.
#pragma once

#include <functional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/grid.h"
#include "fem/stress/recovery/stress_recovery.h"

namespace fem {

/// Stress at all nodes of a mesh by patches, or by averages of the cells.
/// @param loaded_groups  boundary groups that any load acts on
/// @param stress  n_nodes x 6 K, overwritten
void recover_stress(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                    const std::vector<CylinderChart>& charts, const std::vector<int>& loaded_groups,
                    bool by_patches, const ConstBlock& displacement, Eigen::Ref<RowMajor> stress,
                    const NodeSelection& selection = {});

/// Which faces of a part carry no traction, and whether any cell of the body hardly compresses.
struct RecoveryCase {
  std::function<std::vector<BoundaryFace>(const Subdomain&)> free_faces;
  bool hardly_compresses = false;
};
RecoveryCase recovery_case(const Grid& grid, const PerCell<Lame>& elastic,
                           const std::vector<int>& loaded_groups);

/// The same at the nodes that this rank has, on its cells and as many layers around them as these nodes'
/// patches reach: the same steps as on one rank. Called on all ranks.
/// @param by_patches    null: by averages
/// @param displacement  of the nodes that this rank has, rows x 3 K
/// @return rows x 6 K
RowMajor recover_stress_on_ranks(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                                 const std::vector<CylinderChart>& charts, const RecoveryCase* by_patches,
                                 const SharedRows& shared, const ConstBlock& displacement);

}  // namespace fem
