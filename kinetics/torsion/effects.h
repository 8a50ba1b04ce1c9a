/// Effects of a drive train: which there are, and the train that is left when some are off.
#pragma once

#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics::torsion {

/// The kinds of damping, whether a train has them or not.
const std::vector<EffectInfo>& damping_effects();

/// The train with the named effects only: other excitations are left out, other damping is zero.
DriveTrain with_effects(const DriveTrain& train, const std::vector<std::string>& effects);

}  // namespace kinetics::torsion
