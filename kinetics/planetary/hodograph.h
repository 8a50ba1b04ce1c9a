/// The axle's load over all angles in closed form, for any machine, buildable or not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/planetary_effects/machine.h"

namespace kinetics::planetary {

/// @param effects  names, checked
std::optional<PlanetaryHodograph> ellipse(const Machine& machine, const std::vector<std::string>& effects);

}  // namespace kinetics::planetary
