/// Unit responses by conjugate gradients on the free body. Internal to fem.
#pragma once

#include <optional>
#include <string>

#include "fem/balanced_loads.h"
#include "fem/cell_materials.h"
#include "fem/solver_choice.h"

namespace fem {

/// Load cases that advance together, of so many unknowns each: as many as give vectors of a bounded size, 4
/// at least. More than 16 would take more memory than they save time.
std::size_t loads_per_block(std::size_t n_dofs);

/// @param choice   its coarse level must have been decided (not automatic)
/// @param failure  filled if there is no solution: what happened
/// @return nothing if the iteration stalls or leaves a residual that is not acceptable
/// @throws std::runtime_error as CoarseSpace
std::optional<Solution> solve_iteratively(const Grid& grid, const CellMaterials& materials,
                                          const BalancedLoads& loads, const SolverChoice& choice,
                                          const StepReport& progress, std::string& failure);

}  // namespace fem
