/// Unit responses by conjugate gradients on the free body. Internal to fem.
#pragma once

#include <optional>
#include <string>

#include "fem/loads/balanced_loads.h"
#include "fem/mesh/cell_order.h"
#include "fem/operators/cell_materials.h"
#include "fem/operators/shared_nodes.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// Load cases that advance together, of so many unknowns each: as many as give vectors of a bounded size, 4
/// at least. More than 16 would take more memory than they save time.
std::size_t loads_per_block(std::size_t n_dofs);

/// The same on cells in order. The modulus is taken out of `elastic`: displacements are those of unit loads
/// on a body of modulus 1, divided by modulus_Pa.
/// @param width   load cases that advance together, at most
/// @param shared  nodes that other ranks have, too, which call this together; none: one rank. Grid and forces
/// are then those of this rank's cells, sizes of the loads those of the body.
std::optional<Solution> iterate(const Grid& grid, const CellOrder& order, const PerCell<Lame>& elastic,
                                double modulus_Pa, const BalancedLoads& loads, Eigen::Index width,
                                const SolverChoice& choice, const StepReport& progress, std::string& failure,
                                const SharedNodes* shared = nullptr);

/// @param choice   its coarse level must have been decided (not automatic)
/// @param failure  filled if there is no solution: what happened
/// @return nothing if the iteration stalls or leaves a residual that is not acceptable
/// @throws SolveFailed as CoarseSpace
std::optional<Solution> solve_iteratively(const Grid& grid, const CellMaterials& materials,
                                          const BalancedLoads& loads, const SolverChoice& choice,
                                          const StepReport& progress, std::string& failure);

}  // namespace fem
