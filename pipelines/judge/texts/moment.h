/// Where in the cycle an instant lies.
#pragma once

#include <Eigen/Core>

#include "kinetics/values/load_history.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// The turn of the drive in which an instant lies, and the drive angle there, for messages and tables.
struct Moment {
  int turn = 1;          ///< 1-based
  double angle_rad = 0;  ///< within [0, 2 pi)
};
Moment moment_of(const Scene& scene, const kinetics::LoadHistory& loads, Eigen::Index instant);
/// The moment of a place between the instants, which are equidistant.
/// @param instant  i + share of the step to the next
Moment moment_between(const Scene& scene, const kinetics::LoadHistory& loads, double instant);

}  // namespace pipelines
