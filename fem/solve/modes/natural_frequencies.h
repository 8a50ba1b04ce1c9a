/// Natural frequencies and their shapes. Internal to fem.
#pragma once

#include <vector>

#include "fem/base/values/natural_mode.h"
#include "fem/solve/modes/vibrating_body.h"

namespace fem {

/// The lowest ones, ascending, without the rigid motions that nothing holds.
/// @throws TooManyModes unless n_modes is at least 1 and at most a tenth of what vibrates
/// @throws SolveFailed if a mode leaves more than 1e-4 of its inertia forces unbalanced
std::vector<NaturalMode> natural_frequencies(const VibratingBody& body, int n_modes);

}  // namespace fem
