/// Does the drum close? Forces along their true lines of action against the axle's reaction.
#pragma once

#include <Eigen/Core>

#include "kinetics/planetary_effects/belt.h"
#include "kinetics/values/load_history.h"

namespace kinetics::planetary {

struct Closure {
  Eigen::ArrayXd force;   ///< |sum of forces| / sum of |forces|
  Eigen::ArrayXd moment;  ///< |sum of moments about A| / sum of |parts|
};

/// The charge acts at its centroid, the strands at their tangent points, the trunnions at A; without a belt
/// the drive couple is in its place.
/// @param history  with its resultants
Closure closure(const Machine& machine, const LoadHistory& history, const Tensions* belt);

}  // namespace kinetics::planetary
