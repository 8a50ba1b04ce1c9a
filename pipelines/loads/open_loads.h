/// Loads of a body that the scene's own supports could carry, and do not.
#pragma once

#include <vector>

#include "pipelines/loads/load_collector.h"
#include "pipelines/scene/body_scene.h"

namespace pipelines {

/// What remains of the loads of a table in directions in which the scene names no support. Other bodies get
/// their reactions from their machine.
/// @throws StageRefused naming the body's table, each key that is missing (bearings, axial_support,
/// torque_support), the force or moment that it has to carry and what to write
void require_supports(const BodyScene& body, const BodyLoads& loads, const std::vector<RegionMass>& regions);

}  // namespace pipelines
