/// What the mesh of a body of tetrahedra costs in the recovered stress, by one solution of the whole body.
#pragma once

#include <vector>

#include "pipelines/judge/estimates/error_budget.h"

namespace pipelines {

/// Quadratic tetrahedra know stress to the second order, recovered stress is of the third: with d what cells
/// differ by from the recovered stress around the point, relative, its own error grows like d^(3/2), whatever
/// the size of the cells. (A single cell's stress at its corner is no yardstick: it is off by 10 to 70 times
/// the error of the recovered one.)
///   error / stress = max(12 d^(3/2), d / 2)
/// (fitted.h). Costs nothing, and tells which places are worth a submodel.
inline constexpr const char* tetrahedra_method =
    "recovered stress against the cells around, to the power of their orders";

/// The "discretisation" entry of a body of tetrahedra.
/// @param point    where more than one node counts, each for itself
/// @param factors  one per channel
ErrorEntry tetrahedra_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                               const fem::Material& material, const std::vector<double>& factors);

}  // namespace pipelines
