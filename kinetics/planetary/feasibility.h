/// Whether the machine can be built: belt, pulleys, drums.
#pragma once

#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"

namespace kinetics::planetary {

/// Three conditions: the belt exists (|r_O - r_A| <= l_OA, c >= k), both pulleys fit into one plane
/// (r_O + r_A <= l_OA, k <= c / (1 + 2c)), two opposite drums fit (r_b < l_OA, (1 - k) / k > b).
/// @return under the two conventions of the paper, a sentence per condition that is broken
/// @throws MachineRefused under `consistent`, for the first that is broken; under every convention
///         for a belt that does not exist, unless belt_beyond_geometry is set, and for Eytelwein's belt
///         without wrap
std::vector<std::string> check_feasibility(const PlanetaryMill& mill);

}  // namespace kinetics::planetary
