/// Effects of a drive train: which there are, and the train that is left when some are off.
#pragma once

#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics::torsion {

/// The kinds of damping, whether a train has them or not.
const std::vector<EffectInfo>& damping_effects();

}  // namespace kinetics::torsion
