/// Unit responses by one factorisation on a statically determinate support. Internal to fem.
#pragma once

#include <functional>
#include <optional>

#include "fem/loads/balanced_loads.h"
#include "fem/operators/cell_materials.h"

namespace fem {

/// Of the stiffness, without computing it.
FactorSize analyse_factor(const Grid& grid, const CellsOfNodes& cells);

/// @param is_too_expensive asked once the matrix is analysed: if so, nothing is solved and nothing returned
/// @throws SolveFailed as CholmodFactor, or if rounding reaches more than 1 % of displacements
std::optional<Solution> solve_directly(const Grid& grid, const CellsOfNodes& cells,
                                       const std::vector<std::vector<std::int32_t>>& colours,
                                       const CellMaterials& materials, const BalancedLoads& loads,
                                       const StepReport& progress,
                                       const std::function<bool(const FactorSize&)>& is_too_expensive = {});

/// The largest share of a load case's displacement that the correction is; of those cases that need one.
double rounding(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& correction,
                const Eigen::MatrixXd& displacement, const BalancedLoads& loads);

/// @throws SolveFailed naming the remedy if it is more than 1 %
void refuse_rounding(const Grid& grid, double share);

}  // namespace fem
