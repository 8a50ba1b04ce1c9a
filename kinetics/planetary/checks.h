/// Wrong input to the planetary mill is refused here, before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"

namespace kinetics::planetary {

/// Parameters that no effect uses may be zero; NaN, infinity and negative masses are refused everywhere.
/// @throws MachineRefused naming the parameter, its value and the remedy
void check_parameters(const PlanetaryMill& mill, const std::vector<std::string>& effects);

/// @throws MachineRefused for an unknown effect (with the nearest known one), one that has another
///         name in this convention or belongs to a body, one that is named twice
void check_effects(PlanetaryConvention convention, const std::vector<std::string>& effects);

/// "as_published", "as_plotted", "consistent"
std::string name_of(PlanetaryConvention convention);

}  // namespace kinetics::planetary
