/// Submodels around the places that may govern (fem/refine/submodel/submodel.h): what the mesh of the whole
/// body costs there, and stress at weld toes on cells a quarter as large.
#pragma once

#include <vector>

#include "fem/refine/submodel/submodel.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/judge/estimates/hot_spots.h"

namespace pipelines {

inline constexpr const char* submodel_method =
    "change of the stress in submodels around, cells cut into 8 and 64";

/// Error of the stress at a node by submodels: two layers of cells cut once and twice, and three layers cut
/// once. What the largest stress within the first layer changes by is what the mesh of the whole body is
/// wrong by there, up to what the finest cells still change (second term) and what the rim holds wrong (third
/// one; S: layers, cuts):
///   error = 3/2 |S22 - s| + |S22 - S21| + |S31 - S21|
/// 3/2: cells a quarter as large find two thirds of what is missing at order 0.8 and more.
/// @param left_out  places kept out of the peak; null: none
double submodel_error_Pa(const StressPoint& point, const fem::UnitResponses& responses, const fem::Body& body,
                         const BodyLoads& loads, const fem::LeftOut& left_out);

/// Solves the largest toes once more in submodels: all that may hold the largest stress as long as no toe is
/// off by more than largest_error_of_toes; but for those on a loaded surface, which a
/// submodel holds. Their stress over the cycle is the submodel's, on two layers of cells around both
/// reference points, cut twice. At the instant of the largest stress two smaller ones tell its error:
///   error = 3/2 |S22 - S21| + 2 |S31 - S21|
/// 3/2: halved cells find two fifths of what is missing at order 0.74 and more.
/// @param spots  in descending order, before and after
/// @param known  hot spots of the same responses under other loads: toes resolved there are not solved again
/// @throws fem::SolveFailed as submodel_stress
void resolve_hot_spots(const std::vector<meshes::HotSpot>& of_mesh, const fem::UnitResponses& responses,
                       const fem::Body& body, const BodyLoads& loads, std::vector<HotSpotStress>& spots,
                       const std::vector<HotSpotStress>& known = {});

}  // namespace pipelines
