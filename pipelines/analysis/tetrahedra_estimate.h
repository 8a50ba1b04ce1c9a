/// What the mesh of a body of tetrahedra costs in the recovered stress, by one solution of the whole body.
#pragma once

#include <vector>

#include "pipelines/analysis/error_budget.h"

namespace pipelines {

/// Quadratic tetrahedra know stress to the second order, recovered stress is of the third: with d what cells
/// differ by from the recovered stress around the point, relative, its own error grows like d^(3/2), whatever
/// the size of the cells. (A single cell's stress at its corner is no yardstick: it is off by 10 to 70 times
/// the error of the recovered one.)
///   error / stress = max(12 d^(3/2), d / 2)
/// Calibrated by tests/benchmarks/run step_parts: five shafts, 8 to 26 cells around a circle. Costs nothing,
/// and tells which places are worth a submodel.
inline constexpr double tetrahedra_factor = 12, tetrahedra_exponent = 1.5, tetrahedra_least_share = 0.5;

inline constexpr const char* tetrahedra_method =
    "recovered stress against the cells around, to the power of their orders";

/// The "discretisation" entry of a body of tetrahedra.
/// @param point    where more than one node counts, each for itself
/// @param factors  one per channel
ErrorEntry tetrahedra_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                               const fem::Material& material, const std::vector<double>& factors);

/// Submodels at one node (fem/submodel/submodel.h): two layers of cells cut once and twice, and three layers
/// cut once. What the largest stress within the first layer changes by is what the mesh of the whole body is
/// wrong by there, up to what the finest cells still change (second term) and what the rim holds wrong (third
/// one; S: layers, cuts):
///   error = 3/2 |S22 - s| + |S22 - S21| + |S31 - S21|
/// 3/2: cells a quarter as large find two thirds of what is missing at order 0.8 and more. On five shafts, 8
/// to 20 cells around a circle, S22 was 0 to 5 % off, from 10 cells on 0 to 1 % (tests/README.md).
/// @param left_out  one per node, or empty: nodes kept out of the peak
double submodel_error_Pa(const StressPoint& point, const fem::UnitResponses& responses,
                         const fem::Material& material, const BodyLoads& loads,
                         const std::vector<char>& left_out);

inline constexpr const char* submodel_method =
    "change of the stress in submodels around, cells cut into 8 and 64";

}  // namespace pipelines
