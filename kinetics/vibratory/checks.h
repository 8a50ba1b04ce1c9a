/// Wrong input to the vibratory mill is refused here, before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "kinetics/vibratory_effects/mill.h"

namespace kinetics::vibratory {

/// Parameters that no effect uses may be zero; NaN, infinity and negative masses are refused everywhere.
/// @throws MachineRefused naming the parameter, its value and the remedy
void check_parameters(const VibratoryMill& mill, const std::vector<std::string>& effects);

/// @throws MachineRefused for an unknown effect (with the nearest known one), one that belongs to
///         the other convention or to the pipeline, one that is named twice, one that lacks its base effect
void check_effects(Convention convention, const std::vector<std::string>& effects);

}  // namespace kinetics::vibratory
